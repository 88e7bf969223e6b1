// A device and the source of its ticks: its own thread and the machine's clock, or the caller of the loop's step().
// Borrows; any thread.
#pragma once

#include "haptics/device/simulated_device.h"

namespace haptics {

struct ServedDevice {
  HapticDevice& device;
  SimulatedDevice* stepped = nullptr;

  ServedDevice(HapticDevice& ticking) : device(ticking) {}  // NOLINT(google-explicit-constructor)

  static ServedDevice steppedManually(SimulatedDevice& stepped) {
    ServedDevice served(stepped);
    served.stepped = &stepped;
    return served;
  }
};

}  // namespace haptics
