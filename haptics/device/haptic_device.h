// A hand and a motor behind one interface: handle states out, forces in. A device knows nothing of bone or servo.
// Frame D, mm, N. exchange() is called by the servo thread once a tick and must not allocate, lock or block.
// Construction may throw DeviceError; a constructed device is usable.
#pragma once

#include <stdexcept>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct HandleState {
  calibration::Pose<calibration::Device, calibration::Handle> X_DH;
  calibration::Vector<calibration::Device> velocity_D_mm_per_s;
  bool pedal = false;
  bool healthy = true;
};

struct DeviceCapabilities {
  double peak_force_N = 3.3;
};

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual DeviceCapabilities capabilities() const = 0;
  /// Serves last tick's force on the hand and returns where the hand is now. Servo thread; bounded.
  virtual HandleState exchange(const calibration::Vector<calibration::Device>& force_D_N, double dt_s) noexcept = 0;
};

}  // namespace haptics
