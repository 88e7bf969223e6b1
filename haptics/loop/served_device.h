// A device, and who makes it tick: itself, on its own thread and by the machine's clock; or, by hand, whoever steps the
// loop that serves it. Borrows; any thread.
#pragma once

#include "haptics/device/device_in_numbers.h"

namespace haptics {

struct ServedDevice {
  HapticDevice& device;
  DeviceInNumbers* by_hand = nullptr;

  // A device ticks by itself unless somebody says otherwise.
  ServedDevice(HapticDevice& ticking) : device(ticking) {}  // NOLINT(google-explicit-constructor)

  static ServedDevice byHand(DeviceInNumbers& stepped) {
    ServedDevice served(stepped);
    served.by_hand = &stepped;
    return served;
  }
};

}  // namespace haptics
