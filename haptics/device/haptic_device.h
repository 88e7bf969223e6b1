// A hand and a motor behind one interface: handle states out, forces in. A device knows nothing of bone or servo.
// Frame D, mm, N. exchange() is called by the servo thread once a tick and must not allocate, lock or block.
// Construction may throw DeviceError; a constructed device is usable.
#pragma once

#include <stdexcept>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/wrench.h"

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

/// Defaults: a Touch-class device in a light grip (reference/devices 4.3, physics 2.5).
struct DeviceCapabilities {
  double peak_force_N = 3.3, continuous_force_N = 0.88;
  double peak_torque_Nmm = 0.0;      ///< about the handle; 0: the device has none
  double damping_Ns_per_mm = 0.002;  ///< physical, of device and hand: what takes the energy that sampling leaks

  bool hasTorque() const { return peak_torque_Nmm > 0.0; }
};

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual DeviceCapabilities capabilities() const = 0;
  /// Serves last tick's wrench on the hand, torque about the origin of H, and returns where the hand is now. A device
  /// without torque is given none. Servo thread; bounded.
  virtual HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept = 0;
};

}  // namespace haptics
