// A haptic device behind one interface: handle states out, motor commands in. The device drives: from start() to stop()
// it calls its DeviceServo once a tick, on one thread of its own. It includes neither bone nor servo. Frame D, mm, N,
// rad. Construction may throw DeviceError; a constructed device is usable. start(), stop(): one thread. motorsOff():
// any thread, at any time, also while the servo hangs. Facts of real devices: reference/devices.
#pragma once

#include <cstdint>
#include <string>

#include "calibration/arm/arm_correction.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/device/device_error.h"
#include "haptics/motor_command.h"

namespace haptics {

/// One measurement, once a tick.
struct HandleState {
  calibration::Pose<calibration::Device, calibration::Handle> X_DH;
  calibration::Vector<calibration::Device> velocity_D_mm_per_s;
  /// dx = J dq of the motor-driven joints, mm/rad, columns as joints; their torque is J^T F. Zero: not known.
  glm::dmat3 jacobian_D_mm{0.0};
  /// Raw sensor angles of a Phantom's arm and gimbal; a calibration corrects them.
  calibration::RawJoints joints_rad{};
  bool has_joints = false;    ///< all six are measured
  std::uint32_t buttons = 0;  ///< bit 0: the first button
  bool pedal = false;         ///< a pedal, or the button that replaces it
  bool fresh = true;          ///< new since the last tick
  bool docked = false;        ///< in its inkwell
  bool held = true;           ///< the deadman senses a hand; true without a deadman
  bool calibrated = true;     ///< the pose is valid
  bool healthy = true;        ///< false: the device reports a fault, or is gone
  double motor_heat = 0.0;    ///< warmest motor, 0 cold to 1 the limit
};

enum class Provenance : std::uint8_t { simulated, replay, public_protocol, vendor_library };

struct WorkspaceBox {
  glm::dvec3 min_D_mm{-1e3}, max_D_mm{1e3};
};

/// Defaults: a Touch-class device in a light grip (reference/devices 4.3, physics 2.5), simulated, without motors.
struct DeviceCapabilities {
  std::string model = "simulated", serial;
  std::string arm_model;  ///< key of calibration/arm/phantom_models; empty: no known arm
  Provenance provenance = Provenance::simulated;
  bool has_motors = false;      ///< can exert force: has to be armed first (haptics/safety)
  bool has_orientation = true;  ///< false: X_DH never rotates, the rehearsal keeps the tool at a fixed orientation
  bool has_inkwell = false, has_deadman = false;
  bool pauses_with_ticks = false;   ///< a simulated world: no time passes in it between two ticks, however late
  bool force_is_calibrated = true;  ///< false: the force scale has not been measured
  double peak_force_N = 3.3, continuous_force_N = 0.88;
  double peak_torque_Nmm = 0.0;           ///< about the handle; 0: none
  glm::dvec3 peak_joint_torque_Nmm{0.0};  ///< of the motor-driven joints; 0: not known
  double max_stiffness_N_per_mm = 20.0;   ///< recommended by its maker or users
  double max_damping_Ns_per_mm = 0.005;   ///< likewise
  double damping_Ns_per_mm = 0.002;       ///< physical, of device and hand; absorbs the energy that sampling adds
  double min_rate_Hz = 500.0, max_rate_Hz = 10'000.0;
  WorkspaceBox workspace;
};

/// When a tick happened.
struct TickTiming {
  double late_us = 0.0;      ///< from its deadline to the wake-up of the device's thread
  std::uint64_t missed = 0;  ///< deadlines without a tick since the last one
  std::int64_t at_ns = 0;    ///< when the state was sensed, by the clock of the ticks
  double gap_s = 0.0;        ///< since the tick before, if that was late; set by the loop
};

/// What a device calls, on its own thread only; must not allocate, lock, block or throw.
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
  /// Begins to tick at `rate_Hz`, motors off until a command with motors on. Once only. Throws DeviceError when the
  /// device is gone or does not support this rate.
  virtual void start(DeviceServo& servo, double rate_Hz) = 0;
  /// No call of the servo after it; the last command to the motors is zero force, then off. Allowed after a start that
  /// threw, and repeatedly.
  virtual void stop() noexcept = 0;
  /// Motors off at once, the ticks go on. A command made before is dropped, one of a later tick is executed. Must not
  /// wait for the servo.
  virtual void motorsOff() noexcept = 0;

  /// What is wrong, or what the user has to do now, in one sentence; empty: nothing. Any thread but the device's.
  virtual std::string trouble() const { return {}; }
  /// The handle is at its home or reset position now, for devices that are homed so. Any thread.
  virtual void setHome() noexcept {}
};

}  // namespace haptics
