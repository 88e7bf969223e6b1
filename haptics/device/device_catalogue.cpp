#include "haptics/device/device_catalogue.h"

#include <array>
#include <functional>

#include "haptics/device/openhaptics/find_open_haptics.h"
#include "haptics/device/pedal/found_pedal.h"
#include "haptics/device/simulated/phantom_mechanics.h"
#include "haptics/device/usb/falcon.h"
#include "haptics/device/usb/known_devices.h"
#include "haptics/device/usb/wooden_haptics.h"

namespace haptics {
namespace {

constexpr std::array<DeviceKind, 6> kKinds = {{
    {"openhaptics", "Phantom, Touch, Touch X by SensAble and 3D Systems", "OpenHaptics, the maker's library",
     "a stand-in for that library", true, false},
    {"wooden", "WoodenHaptics with its mbed firmware", "libusb", "simulated units behind the real libusb", true, false},
    {"falcon", "Novint Falcon", "libusb", "simulated units behind the real libusb", true, false},
    {"pedal", "foot switches, joysticks, gamepads", "libevdev", "simulated devices behind the real libevdev", true,
     false},
    {"simulated", "Phantom Omni, Touch, Desktop, Premium 1.5 in numbers", "Molar", "their published numbers", false,
     false},
    {"mouse", "the mouse, a place without force", "the window", "itself", false, false},
}};

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

}  // namespace

std::span<const DeviceKind> deviceKinds() { return kKinds; }

DeviceCatalogue findDevices() {
  DeviceCatalogue catalogue;
  const auto add = [&](const std::function<std::vector<FoundDevice>()>& find) {
    try {
      for (FoundDevice& device : find()) catalogue.devices.push_back(std::move(device));
    } catch (const DeviceError& error) {
      catalogue.troubles.emplace_back(error.what());
    }
  };
  add([] { return findOpenHaptics(); });
  add(findPresent);
  add(findWoodenHaptics);
  add(findFalcon);
  add(findFeet);
  add(findSimulated);
  return catalogue;
}

}  // namespace haptics
