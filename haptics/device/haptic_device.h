// A hand and its motors behind one interface: handle states out, motor commands in. The device drives: from start() to
// stop() it calls its DeviceServo once a tick from one thread of its own. A device knows nothing of bone or servo.
// Frame D, mm, N, rad. Construction may throw DeviceError; a constructed device is usable. start(), stop(): one thread.
// motorsOff(): any thread, at any time, also beside a hanging servo. Facts of real devices: reference/devices.
#pragma once

#include <cstdint>
#include <string>

#include "calibration/arm/arm_correction.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/device/device_error.h"
#include "haptics/motor_command.h"

namespace haptics {

/// What a device measures, once a tick.
struct HandleState {
  calibration::Pose<calibration::Device, calibration::Handle> X_DH;
  calibration::Vector<calibration::Device> velocity_D_mm_per_s;
  /// dx = J dq of the motor-driven joints, mm/rad, columns as joints; their torque is J^T F. Zero where not known.
  glm::dmat3 jacobian_D_mm{0.0};
  /// What the sensors of a Phantom's arm and gimbal read, before any model: what a calibration corrects.
  calibration::RawJoints joints_rad{};
  bool has_joints = false;    ///< false: the device has none, or does not tell them all
  std::uint32_t buttons = 0;  ///< bit 0: the first
  bool pedal = false;         ///< a pedal, or what stands for one on the device
  bool fresh = true;          ///< measured since the last tick
  bool docked = false;        ///< in its inkwell
  bool held = true;           ///< the deadman feels a hand; true where there is none
  bool calibrated = true;     ///< the pose can be believed
  bool healthy = true;        ///< false: the device reports trouble, or is gone
  double motor_heat = 0.0;    ///< of the warmest motor, 0 cold to 1 as warm as allowed
};

enum class Provenance : std::uint8_t { simulated, replay, public_protocol, vendor_library };

struct WorkspaceBox {
  glm::dvec3 min_D_mm{-1e3}, max_D_mm{1e3};
};

/// Defaults: a Touch-class device in a light grip (reference/devices 4.3, physics 2.5), simulated and without motors.
struct DeviceCapabilities {
  std::string model = "simulated", serial;
  std::string arm_model;  ///< key of calibration/arm/phantom_models; empty: no arm whose model is known
  Provenance provenance = Provenance::simulated;
  bool has_motors = false;  ///< somebody can be pushed: the hand must be armed first (safety/readiness)
  bool has_orientation = true, has_inkwell = false, has_deadman = false;
  bool force_is_calibrated = true;  ///< false: its newtons are a guess until a scale has weighed them
  double peak_force_N = 3.3, continuous_force_N = 0.88;
  double peak_torque_Nmm = 0.0;           ///< about the handle; 0: the device has none
  glm::dvec3 peak_joint_torque_Nmm{0.0};  ///< of the motor-driven joints; 0: not known
  double max_stiffness_N_per_mm = 20.0;   ///< that its maker or users recommend
  double max_damping_Ns_per_mm = 0.005;   ///< the same
  double damping_Ns_per_mm = 0.002;       ///< physical, of device and hand: takes the energy that sampling leaks
  double min_rate_Hz = 500.0, max_rate_Hz = 10'000.0;
  WorkspaceBox workspace;

  bool hasTorque() const { return peak_torque_Nmm > 0.0; }
};

/// How punctual a tick is.
struct TickTiming {
  double late_us = 0.0;      ///< from when it was due to when the device's thread woke
  std::uint64_t missed = 0;  ///< ticks that were due since the last one and did not happen
  std::int64_t at_ns = 0;    ///< when the state was sensed, by the clock that the ticks go by
  double gap_s = 0.0;        ///< since the tick before, where that is late; the loop's
};

/// Whom a device serves. Called from the device's own thread only; must not allocate, lock, block or throw.
class DeviceServo {
 public:
  virtual ~DeviceServo() = default;
  /// Once, before the first tick.
  virtual void begin() noexcept {}
  virtual MotorCommand tick(const HandleState& state, const TickTiming& timing) noexcept = 0;
};

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceCapabilities& capabilities() const = 0;
  /// Begins to tick at `rate_Hz`, motors off until a command says otherwise. Once in its life. Throws DeviceError when
  /// the device has gone or can not be served at this rate.
  virtual void start(DeviceServo& servo, double rate_Hz) = 0;
  /// No call of the servo after it; the last thing the motors were told is no force, then off. Also after a start that
  /// threw, and twice.
  virtual void stop() noexcept = 0;
  /// Motors off at once, the ticks go on. A command made before is not obeyed any more, one of a later tick is. Must
  /// not wait for the servo.
  virtual void motorsOff() noexcept = 0;

  /// What is wrong with the device, or what a person has to do now, in one sentence; empty: all is well. Any thread but
  /// the device's.
  virtual std::string trouble() const { return {}; }
  /// The handle stands at its home or reset position now; for devices that must be told. Any thread.
  virtual void setHome() noexcept {}
};

}  // namespace haptics
