// Haptic devices by their USB identity: which device, of which kind, what its owner has to do next. One table of
// identities for searches, the presence monitor, the doctor and the udev rules. Touch units by 3D Systems are 2988:*,
// early ones 0301:2988 with the two ids swapped; USB classes 2 and 10 are the serial kind, class 3 the HID kind. Their
// protocol is not published, so Molar does not drive them over USB. Plain functions, any thread. Sources:
// reference/devices 1, 3.
#pragma once

#include <optional>
#include <span>

#include "haptics/device/found_device.h"
#include "haptics/device/usb/usb_devices.h"

namespace haptics {

enum class KnownDevice { touch_serial, touch_hid, touch_of_another_kind, force_dimension, falcon, wooden_haptics };

struct UsbIdentity {
  KnownDevice kind;  ///< which kind of Touch, its interface classes decide
  const char* name;
  std::uint16_t vendor, product;  ///< product 0: any
};
std::span<const UsbIdentity> usbIdentities();

std::optional<KnownDevice> knownAs(const UsbDevice& device);
/// Driven by its maker's library or not at all.
bool isClosed(KnownDevice kind);
FoundDevice described(KnownDevice kind, const UsbDevice& device);

/// The devices plugged in, found without opening any. Throws DeviceError when the USB cannot be searched.
std::vector<FoundDevice> findClosed();  ///< those that another driver would drive
std::vector<FoundDevice> findFalcon();
std::vector<FoundDevice> findWoodenHaptics();

}  // namespace haptics
