// A device, and who makes it tick: itself, on its own thread and by the machine's clock; or, by hand, whoever steps the
// loop that serves it. Borrows; any thread.
#pragma once

#include "haptics/device/simulated_device.h"

namespace haptics {

struct ServedDevice {
  HapticDevice& device;
  SimulatedDevice* stepped = nullptr;

  // A device ticks by itself unless somebody says otherwise.
  ServedDevice(HapticDevice& ticking) : device(ticking) {}  // NOLINT(google-explicit-constructor)

  static ServedDevice steppedManually(SimulatedDevice& stepped) {
    ServedDevice served(stepped);
    served.stepped = &stepped;
    return served;
  }
};

}  // namespace haptics
