#include "app/doctor/haptic_usb.h"

#include <optional>

#include <fmt/core.h>

#include "app/text/parse_number.h"
#include "haptics/device/usb/known_devices.h"

namespace app {
namespace {

struct Identity {
  std::uint16_t vendor, product;
};

/// Units that a doctor has something to say of.
std::optional<UnitMaker> makerOf(const Identity& is) {
  haptics::UsbDevice device;
  device.vendor = is.vendor;
  device.product = is.product;
  const auto kind = haptics::knownAs(device);
  if (!kind || *kind == haptics::KnownDevice::force_dimension) return {};
  if (*kind == haptics::KnownDevice::falcon) return UnitMaker::falcon;
  return *kind == haptics::KnownDevice::wooden_haptics ? UnitMaker::wooden_haptics : UnitMaker::systems_3d;
}

std::string nameOf(UnitMaker maker, const Identity& is) {
  const char* name = maker == UnitMaker::systems_3d ? "3D Systems unit"
                     : maker == UnitMaker::falcon   ? "Novint Falcon"
                                                    : "WoodenHaptics";
  return fmt::format("{} ({:04x}:{:04x})", name, is.vendor, is.product);
}

/// ttyACM* and hidraw* anywhere below; links lead elsewhere and are not followed.
void addNodes(HapticUnit& unit, const std::filesystem::path& folder, const std::filesystem::path& dev) {
  std::error_code none;
  for (std::filesystem::recursive_directory_iterator at(folder, none), end; at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    const bool is_tty = name.starts_with("ttyACM");
    if (is_tty || (name.starts_with("hidraw") && name != "hidraw")) unit.nodes.push_back(dev / name);
    unit.is_serial = unit.is_serial || is_tty;
    if (none) break;
  }
}

/// A unit and its interfaces, both entries of one folder: "1-2", "1-2:1.0".
HapticUnit unitAt(const std::filesystem::path& entry, UnitMaker maker, const Identity& is, const Machine& machine) {
  HapticUnit unit{maker, nameOf(maker, is), {}};
  const int bus = parseNumber<int>(firstLine(entry / "busnum").value_or("")).value_or(0);
  const int device = parseNumber<int>(firstLine(entry / "devnum").value_or("")).value_or(0);
  unit.nodes.push_back(machine.dev / fmt::format("bus/usb/{:03}/{:03}", bus, device));
  for (const auto& beside : entriesOf(entry.parent_path()))
    if (beside.filename().string().starts_with(entry.filename().string() + ":")) addNodes(unit, beside, machine.dev);
  return unit;
}

}  // namespace

std::vector<HapticUnit> hapticUnits(const Machine& machine) {
  std::vector<HapticUnit> units;
  for (const auto& entry : entriesOf(machine.sys / "bus/usb/devices")) {
    const auto vendor = parseNumber<std::uint16_t>(firstLine(entry / "idVendor").value_or(""), 16);
    const auto product = parseNumber<std::uint16_t>(firstLine(entry / "idProduct").value_or(""), 16);
    if (!vendor || !product) continue;
    const Identity is{*vendor, *product};
    if (const auto maker = makerOf(is)) units.push_back(unitAt(entry, *maker, is, machine));
  }
  return units;
}

std::string udevRules() {
  struct Rule {
    const char *comment, *vendor, *product;
  };
  constexpr Rule kRules[] = {
      {"3D Systems Touch and its kin", "2988", "*"},
      {"3D Systems Touch, early firmware: vendor and product the wrong way round", "0301", "2988"},
      {"WoodenHaptics", "1234", "0006"},
      {"Novint Falcon", "0403", "cb48"},
  };
  std::string text = std::string("# ") + kUdevRulesFile +
                     ": who sits at this machine may use its haptic devices and pedals.\n"
                     "# Then: sudo udevadm control --reload && sudo udevadm trigger, and plug the device in again.\n";
  for (const Rule& rule : kRules) {
    const std::string is =
        std::string("ATTRS{idVendor}==\"") + rule.vendor + "\", ATTRS{idProduct}==\"" + rule.product + "\"";
    text += std::string("\n# ") + rule.comment + "\n";
    text += "SUBSYSTEM==\"usb\", " + is + ", TAG+=\"uaccess\", ENV{ID_MM_DEVICE_IGNORE}=\"1\"\n";
    text += "SUBSYSTEM==\"tty\", " + is + ", TAG+=\"uaccess\", ENV{ID_MM_DEVICE_IGNORE}=\"1\"\n";
    text += "SUBSYSTEM==\"hidraw\", " + is + ", TAG+=\"uaccess\"\n";
  }
  text += "\n# foot switches and joysticks; keyboards stay as they are\n";
  text += "SUBSYSTEM==\"input\", KERNEL==\"event*\", ENV{ID_INPUT_JOYSTICK}==\"1\", TAG+=\"uaccess\"\n";
  text += "SUBSYSTEM==\"input\", KERNEL==\"event*\", ATTRS{name}==\"*[Ff]oot*\", TAG+=\"uaccess\"\n";
  text += "SUBSYSTEM==\"input\", KERNEL==\"event*\", ATTRS{name}==\"*[Pp]edal*\", TAG+=\"uaccess\"\n";
  return text;
}

}  // namespace app
