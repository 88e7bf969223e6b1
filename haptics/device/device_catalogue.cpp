#include "haptics/device/device_catalogue.h"

#include <algorithm>
#include <array>

#include "haptics/device/openhaptics/find_open_haptics.h"
#include "haptics/device/pedal/found_pedal.h"
#include "haptics/device/simulated/phantom_mechanics.h"
#include "haptics/device/usb/falcon.h"
#include "haptics/device/usb/known_devices.h"
#include "haptics/device/usb/wooden_haptics.h"

namespace haptics {
namespace {

std::vector<FoundDevice> findSimulated() {
  std::vector<FoundDevice> found;
  for (const PhantomMechanics& one : simulatedPhantoms()) {
    FoundDevice simulated;
    simulated.name = "simulated " + std::string(one.name);
    simulated.address = "simulated:" + std::string(one.key);
    simulated.place = "in numbers";
    simulated.provenance = Provenance::simulated;
    simulated.driver = "Molar";
    found.push_back(simulated);
  }
  return found;
}

std::vector<FoundDevice> findFeet() {
  std::vector<FoundDevice> found;
  for (const FoundPedal& one : findPedals()) {
    FoundDevice pedal;
    pedal.name = one.traits.name;
    pedal.place = one.path.string();
    pedal.driver = "libevdev";
    pedal.address = "pedal:" + one.path.string();
    if (!one.may_be_read) pedal.advice = "install the udev rule that `molar doctor --udev-rules` prints and replug it";
    found.push_back(pedal);
  }
  return found;
}

std::vector<FoundDevice> findPhantoms() { return findOpenHaptics(); }

bool isWooden(const std::string& place) { return woodenAddressed("wooden:" + place).has_value(); }

constexpr std::array<DeviceKind, 6> kKinds = {{
    {"openhaptics", "[:NAME]", "Phantom, Touch, Touch X by SensAble and 3D Systems", "OpenHaptics, the maker's library",
     "a stand-in for that library", Bus::library, false, findPhantoms, openPhantom},
    {"wooden", "[:BUS-PORT][,BUILD]", "WoodenHaptics with its mbed firmware", "libusb",
     "simulated units behind the real libusb", Bus::usb, false, findWoodenHaptics, openWooden, isWooden},
    {"falcon", "[:BUS-PORT]", "Novint Falcon", "libusb", "simulated units behind the real libusb", Bus::usb, false,
     findFalcon, openFalcon},
    {"pedal", ":PATH", "foot switches, joysticks, gamepads", "libevdev", "simulated devices behind the real libevdev",
     Bus::input, false, findFeet},
    {"simulated", "[:MODEL]", "Phantom Omni, Touch, Desktop, Premium 1.5 in numbers", "Molar",
     "their published numbers", Bus::none, false, findSimulated},
    {"mouse", "", "the mouse, a place without force", "the window", "itself"},
}};

constexpr std::string_view kFirstOnTheUsb = "usb";

/// Behind the scheme and its colon.
std::string placeIn(const std::string& address) {
  const std::size_t colon = address.find(':');
  return colon == std::string::npos ? std::string() : address.substr(colon + 1);
}

const DeviceKind* openedKindOf(const std::string& address) {
  const std::string scheme = address.substr(0, address.find(':'));
  const auto kind = std::ranges::find(kKinds, scheme, &DeviceKind::key);
  if (kind == kKinds.end() || !kind->open || (kind->takes && !kind->takes(placeIn(address)))) return nullptr;
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
      for (FoundDevice& device : find()) catalogue.devices.push_back(std::move(device));
    } catch (const DeviceError& error) {
      catalogue.troubles.push_back(error);
    }
  };
  add(findPresent);  // those that another driver than Molar's would drive
  for (const DeviceKind& kind : kKinds)
    if (kind.find) add(kind.find);
  return catalogue;
}

bool isDeviceAddress(const std::string& address) {
  return address == kFirstOnTheUsb || openedKindOf(address) != nullptr;
}

OpenedDevice openDevice(const std::string& asked, const DeviceOptions& options) {
  const std::string address = asked == kFirstOnTheUsb ? firstOnTheUsb() : asked;
  const DeviceKind* const kind = openedKindOf(address);
  if (!kind)
    throw DeviceError("--device " + asked +
                      ": it is not the address of a device, see molar devices for those that are there");
  OpenedDevice opened = kind->open(placeIn(address), options);
  opened.address = address;
  return opened;
}

}  // namespace haptics
