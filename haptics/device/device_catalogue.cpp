#include "haptics/device/device_catalogue.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "haptics/device/openhaptics/find_open_haptics.h"
#include "haptics/device/pedal/found_pedal.h"
#include "haptics/device/simulated/phantom_mechanics.h"
#include "haptics/device/usb/known_devices.h"
#include "haptics/device/usb/wooden_haptics.h"

namespace haptics {
namespace {

std::vector<FoundDevice> findSimulated() {
  std::vector<FoundDevice> found;
  for (const PhantomMechanics& one : simulatedPhantoms())
    found.push_back({"simulated " + std::string(one.name), "simulated:" + std::string(one.key), "simulated",
                     Provenance::simulated, "Molar", ""});
  return found;
}

std::vector<FoundDevice> findFeet() {
  std::vector<FoundDevice> found;
  for (const FoundPedal& one : findPedals())
    found.push_back(
        {one.traits.name, "pedal:" + one.path.string(), one.path.string(), Provenance::public_protocol, "libevdev",
         one.may_be_read ? "" : "install the udev rule that `molar doctor --udev-rules` prints and replug it"});
  return found;
}

std::vector<FoundDevice> findPhantoms() { return findOpenHaptics(); }

bool isWooden(const std::string& rest) { return woodenAddressed("wooden:" + rest).has_value(); }

constexpr std::array<DeviceKind, 6> kKinds = {{
    {"openhaptics", "[:NAME]", "Phantom, Touch, Touch X by SensAble and 3D Systems", "OpenHaptics, the maker's library",
     "a stand-in for that library", Bus::library, false, findPhantoms, openPhantom},
    {"wooden", "[:BUS-PORT][,BUILD]", "WoodenHaptics with its mbed firmware", "libusb",
     "simulated units behind the real libusb", Bus::usb, false, findWoodenHaptics, openWooden, isWooden},
    {"falcon", "[:BUS-PORT]", "Novint Falcon", "libusb", "simulated units behind the real libusb", Bus::usb, false,
     findFalcon, openFalcon},
    {"pedal", ":PATH", "foot switches, joysticks, gamepads", "libevdev", "simulated devices behind the real libevdev",
     Bus::input, false, findFeet},
    {"simulated", "[:MODEL]", "simulated Phantom Omni, Touch, Desktop, Premium 1.5", "Molar", "their published data",
     Bus::none, false, findSimulated},
    {"mouse", "", "the mouse, a position without force", "the window", "itself"},
}};

constexpr std::string_view kFirstOnTheUsb = "usb";

const DeviceKind* openedKindOf(const std::string& address) {
  const auto kind = std::ranges::find(kKinds, address.substr(0, address.find(':')), &DeviceKind::key);
  if (kind == kKinds.end() || !kind->open || (kind->accepts && !kind->accepts(addressRest(address)))) return nullptr;
  return &*kind;
}

std::string firstOnTheUsb() {
  for (const DeviceKind& kind : kKinds)
    if (kind.bus == Bus::usb)
      for (const FoundDevice& found : kind.find())
        if (!found.address.empty()) return found.address;
  throw DeviceError("--device usb: no device that Molar drives is on the USB, see molar devices",
                    DeviceTrouble::not_there);
}

}  // namespace

std::span<const DeviceKind> deviceKinds() { return kKinds; }

DeviceCatalogue findDevices() {
  DeviceCatalogue catalogue;
  const auto add = [&](std::vector<FoundDevice> (*find)()) {
    try {
      std::ranges::move(find(), std::back_inserter(catalogue.devices));
    } catch (const DeviceError& error) {
      catalogue.troubles.push_back(error);
    }
  };
  add(findClosed);
  for (const DeviceKind& kind : kKinds)
    if (kind.find) add(kind.find);
  return catalogue;
}

std::string addressRest(const std::string& address) {
  const std::size_t colon = address.find(':');
  return colon == std::string::npos ? std::string() : address.substr(colon + 1);
}

bool isDeviceAddress(const std::string& address) {
  return address == kFirstOnTheUsb || openedKindOf(address) != nullptr;
}

OpenedDevice openDevice(const std::string& requested, const DeviceOptions& options) {
  const std::string address = requested == kFirstOnTheUsb ? firstOnTheUsb() : requested;
  const DeviceKind* const kind = openedKindOf(address);
  if (!kind)
    throw DeviceError("--device " + requested +
                      ": it is not the address of a device, see molar devices for those that are there");
  OpenedDevice opened = kind->open(addressRest(address), options);
  opened.address = address;
  return opened;
}

}  // namespace haptics
