#include "haptics/device/usb/known_devices.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr std::uint16_t k3DSystems = 0x2988, kSwappedVendor = 0x0301, kForceDimension = 0x1451;
constexpr std::uint8_t kSerialControl = 0x02, kSerialData = 0x0A, kHid = 0x03;

bool hasClass(const UsbDevice& device, std::uint8_t wanted) {
  return device.device_class == wanted || std::find(device.interface_classes.begin(), device.interface_classes.end(),
                                                    wanted) != device.interface_classes.end();
}

bool hasSwappedIds(const UsbDevice& device) { return device.vendor == kSwappedVendor && device.product == k3DSystems; }

FoundDevice touch(const UsbDevice& device, const std::string& kind, const std::string& advice) {
  FoundDevice found;
  found.name = "3D Systems " + (device.name.empty() ? std::string("Touch") : device.name) + " (" + kind + ")";
  found.place = device.place() + (hasSwappedIds(device) ? " (ids swapped)" : "");
  found.provenance = Provenance::vendor_library;
  found.driver = "OpenHaptics by 3D Systems";
  found.advice = advice;
  return found;
}

}  // namespace

std::optional<KnownDevice> knownAs(const UsbDevice& device) {
  const auto is = [&](std::uint16_t vendor, std::uint16_t product) {
    return device.vendor == vendor && device.product == product;
  };
  if (device.vendor == k3DSystems || hasSwappedIds(device)) {
    if (hasClass(device, kSerialControl) || hasClass(device, kSerialData)) return KnownDevice::touch_serial;
    if (hasClass(device, kHid)) return KnownDevice::touch_hid;
    return KnownDevice::touch_of_another_kind;
  }
  if (device.vendor == kForceDimension) return KnownDevice::force_dimension;
  if (is(0x0403, 0xCB48)) return KnownDevice::falcon;
  if (is(0x1234, 0x0006)) return KnownDevice::wooden_haptics;
  return {};
}

bool isClosed(KnownDevice kind) { return kind != KnownDevice::falcon && kind != KnownDevice::wooden_haptics; }

FoundDevice described(KnownDevice kind, const UsbDevice& device) {
  const std::string then = "install it, run its Touch_Setup and use --device openhaptics";
  FoundDevice found;
  found.place = device.place();
  switch (kind) {
    case KnownDevice::touch_serial:
      return touch(device, "USB serial",
                   "needs 3D Systems' Touch driver for the serial kind, " + then +
                       "; ModemManager must leave its serial port alone");
    case KnownDevice::touch_hid:
      return touch(device, "USB HID", "needs 3D Systems' newer Touch driver, which knows the HID kind, " + then);
    case KnownDevice::touch_of_another_kind:
      return touch(device, "unknown kind",
                   "is neither the serial nor the HID kind, ask 3D Systems which of its drivers knows it");
    case KnownDevice::force_dimension:
      found.name = "Force Dimension" + (device.name.empty() ? "" : " " + device.name);
      found.provenance = Provenance::vendor_library;
      found.driver = "none in Molar; its maker's SDK would be needed";
      found.advice = "is not driven by Molar, use another device";
      return found;
    case KnownDevice::falcon:
      found.name = "Novint Falcon";
      found.address = "falcon:" + device.path;
      break;
    case KnownDevice::wooden_haptics:
      found.name = "WoodenHaptics";
      found.address = "wooden:" + device.path;
      break;
  }
  found.driver = "libusb";
  return found;
}

std::vector<FoundDevice> findPresent() {
  std::vector<FoundDevice> found;
  for (const UsbDevice& device : UsbBus().devices())
    if (const auto kind = knownAs(device); kind && isClosed(*kind)) found.push_back(described(*kind, device));
  return found;
}

}  // namespace haptics
