// Haptic devices by what the USB says of them, whoever drives them: which one, of which kind, what its owner does next.
// Touch units by 3D Systems are 2988:*, early ones 0301:2988 with their two ids swapped; classes 2 and 10 are the
// serial kind, class 3 the HID kind. Nobody has published how they are spoken to, so Molar does not speak to them over
// USB. Plain functions, any thread. Sources: reference/devices 1, 3.
#pragma once

#include <optional>

#include "haptics/device/found_device.h"
#include "haptics/device/usb/usb_devices.h"

namespace haptics {

enum class KnownDevice { touch_serial, touch_hid, touch_of_another_kind, force_dimension, falcon, wooden_haptics };

std::optional<KnownDevice> knownAs(const UsbDevice& device);

/// Its maker's library would have to drive it.
bool isClosed(KnownDevice kind);

FoundDevice described(KnownDevice kind, const UsbDevice& device);

/// The closed ones that are plugged in; the open ones have searches of their own. Opens nothing. Throws DeviceError
/// when USB can not be looked at.
std::vector<FoundDevice> findPresent();

}  // namespace haptics
