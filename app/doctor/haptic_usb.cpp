#include "app/doctor/haptic_usb.h"

#include <fmt/core.h>

#include "app/text/parse_number.h"

namespace app {
namespace {

using haptics::KnownDevice;

const char* nameOf(KnownDevice kind) {
  if (haptics::isClosed(kind)) return "3D Systems unit";
  return kind == KnownDevice::falcon ? "Novint Falcon" : "WoodenHaptics";
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

/// A unit and its interfaces are entries of one folder: "1-2", "1-2:1.0".
HapticUnit unitAt(const std::filesystem::path& entry, KnownDevice kind, const std::string& id, const Machine& machine) {
  HapticUnit unit{kind, fmt::format("{} ({})", nameOf(kind), id), {}};
  const int bus = parseNumber<int>(firstLine(entry / "busnum").value_or("")).value_or(0);
  const int device = parseNumber<int>(firstLine(entry / "devnum").value_or("")).value_or(0);
  unit.nodes.push_back(machine.dev / fmt::format("bus/usb/{:03}/{:03}", bus, device));
  for (const auto& sibling : entriesOf(entry.parent_path()))
    if (sibling.filename().string().starts_with(entry.filename().string() + ":")) addNodes(unit, sibling, machine.dev);
  return unit;
}

}  // namespace

std::vector<HapticUnit> hapticUnits(const Machine& machine) {
  std::vector<HapticUnit> units;
  for (const auto& entry : entriesOf(machine.sys / "bus/usb/devices")) {
    haptics::UsbDevice device;
    device.vendor = parseNumber<std::uint16_t>(firstLine(entry / "idVendor").value_or(""), 16).value_or(0);
    device.product = parseNumber<std::uint16_t>(firstLine(entry / "idProduct").value_or(""), 16).value_or(0);
    const auto kind = haptics::knownAs(device);
    if (kind && *kind != KnownDevice::force_dimension) units.push_back(unitAt(entry, *kind, device.id(), machine));
  }
  return units;
}

std::string udevRules() {
  std::string text =
      "# 70-molar.rules: the person at this machine may use its haptic devices and pedals. Belongs in a folder of "
      "udev\n"
      "# rules: /etc/udev/rules.d by hand, /usr/lib/udev/rules.d in a package. After a change:\n"
      "# sudo udevadm control --reload && sudo udevadm trigger, and plug the device in again.\n";
  for (const haptics::UsbIdentity& one : haptics::usbIdentities()) {
    if (one.kind == KnownDevice::force_dimension) continue;
    const std::string product = one.product == 0 ? "*" : fmt::format("{:04x}", one.product);
    const std::string is =
        fmt::format("ATTRS{{idVendor}}==\"{:04x}\", ATTRS{{idProduct}}==\"{}\"", one.vendor, product);
    text += std::string("\n# ") + one.name + "\n";
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
