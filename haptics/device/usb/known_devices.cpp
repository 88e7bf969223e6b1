#include "haptics/device/usb/known_devices.h"

#include <algorithm>
#include <array>

#include "haptics/device/usb/falcon_force_scale.h"
#include "haptics/device/usb/falcon_protocol.h"
#include "haptics/device/usb/wooden_protocol.h"

namespace haptics {
namespace {

constexpr std::uint16_t k3DSystems = 0x2988, kSwappedVendor = 0x0301;
constexpr std::uint8_t kSerialControl = 0x02, kSerialData = 0x0A, kHid = 0x03;

constexpr std::array<UsbIdentity, 5> kIdentities = {{
    {KnownDevice::touch_of_another_kind, "3D Systems Touch and its kin", k3DSystems, 0},
    {KnownDevice::touch_of_another_kind, "3D Systems Touch, early firmware: vendor and product the wrong way round",
     kSwappedVendor, k3DSystems},
    {KnownDevice::wooden_haptics, "WoodenHaptics", kWoodenVendor, kWoodenProduct},
    {KnownDevice::falcon, "Novint Falcon", kFalconVendor, kFalconProduct},
    {KnownDevice::force_dimension, "Force Dimension", 0x1451, 0},
}};

bool hasClass(const UsbDevice& device, std::uint8_t wanted) {
  return device.device_class == wanted || std::ranges::count(device.interface_classes, wanted) > 0;
}

FoundDevice touch(FoundDevice found, const UsbDevice& device, const std::string& kind, const std::string& advice) {
  found.name = "3D Systems " + (device.name.empty() ? std::string("Touch") : device.name) + " (" + kind + ")";
  if (device.vendor == kSwappedVendor) found.location += " (ids swapped)";
  found.driver = "OpenHaptics by 3D Systems";
  found.advice = advice;
  return found;
}

template <class Wanted>
std::vector<FoundDevice> findKnown(const Wanted& wanted) {
  std::vector<FoundDevice> found;
  for (const UsbDevice& device : UsbBus().devices())
    if (const auto kind = knownAs(device); kind && wanted(*kind)) found.push_back(described(*kind, device));
  return found;
}

}  // namespace

std::span<const UsbIdentity> usbIdentities() { return kIdentities; }

std::optional<KnownDevice> knownAs(const UsbDevice& device) {
  const auto known = std::ranges::find_if(kIdentities, [&](const UsbIdentity& one) {
    return one.vendor == device.vendor && (one.product == 0 || one.product == device.product);
  });
  if (known == kIdentities.end()) return {};
  if (known->kind != KnownDevice::touch_of_another_kind) return known->kind;
  if (hasClass(device, kSerialControl) || hasClass(device, kSerialData)) return KnownDevice::touch_serial;
  return hasClass(device, kHid) ? KnownDevice::touch_hid : known->kind;
}

bool isClosed(KnownDevice kind) { return kind != KnownDevice::falcon && kind != KnownDevice::wooden_haptics; }

FoundDevice described(KnownDevice kind, const UsbDevice& device) {
  const std::string then = "install it, run its Touch_Setup and use --device openhaptics";
  FoundDevice found;
  found.location = device.location();
  found.provenance = isClosed(kind) ? Provenance::vendor_library : Provenance::public_protocol;
  found.driver = "libusb";
  switch (kind) {
    case KnownDevice::touch_serial:
      return touch(found, device, "USB serial",
                   "needs 3D Systems' Touch driver for the serial kind, " + then +
                       "; ModemManager must leave its serial port alone");
    case KnownDevice::touch_hid:
      return touch(found, device, "USB HID",
                   "needs 3D Systems' newer Touch driver, which supports the HID kind, " + then);
    case KnownDevice::touch_of_another_kind:
      return touch(found, device, "unknown kind",
                   "is neither the serial nor the HID kind, ask 3D Systems which of its drivers supports it");
    case KnownDevice::force_dimension:
      found.name = "Force Dimension" + (device.name.empty() ? "" : " " + device.name);
      found.driver = "none in Molar; its maker's SDK would be needed";
      found.advice = "is not driven by Molar, use another device";
      return found;
    case KnownDevice::falcon:
      found.name = "Novint Falcon";
      found.address = "falcon:" + device.path;
      found.advice = "give its firmware with --falcon-firmware, it forgets its program with every power-down; " +
                     falconForceAdvice({});
      break;
    case KnownDevice::wooden_haptics:
      found.name = "WoodenHaptics";
      found.address = "wooden:" + device.path;
      break;
  }
  if (!device.may_open) found.advice = "install the udev rules that `molar doctor --udev-rules` prints and replug it";
  return found;
}

std::vector<FoundDevice> findClosed() { return findKnown(isClosed); }

std::vector<FoundDevice> findFalcon() {
  return findKnown([](KnownDevice kind) { return kind == KnownDevice::falcon; });
}

std::vector<FoundDevice> findWoodenHaptics() {
  return findKnown([](KnownDevice kind) { return kind == KnownDevice::wooden_haptics; });
}

}  // namespace haptics
