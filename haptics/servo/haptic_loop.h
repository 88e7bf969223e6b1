// The haptic loop: a device and the servo joined. The device ticks on its own thread; every tick its handle becomes the
// hand's sample, Servo::step answers, and what the motor gate admits of the answer goes back. Owns nothing it serves;
// everything it borrows must outlive it and must not be restructured while it runs. Values cross by Latest and TickLog
// alone. start() and stop() from one other thread; emergencyStop() from any. Real-time priority, a core and locked
// memory are asked for and reported; they are not required. Simulated time is the sum of the ticks' dt whatever the
// clock does, so a replay needs no clock. Runs once: start, stop, and no second start.
#pragma once

#include <atomic>
#include <optional>

#include "haptics/device/haptic_device.h"
#include "haptics/latest.h"
#include "haptics/safety/motor_gate.h"
#include "haptics/servo/realtime.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/servo_statistics.h"
#include "haptics/servo/supervisor.h"
#include "haptics/servo/tick_log.h"

namespace haptics {

struct LoopSettings {
  double rate_Hz = 1000.0;                                            ///< 500..10000
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;  ///< where the device stands
  calibration::Pose<calibration::Handle, calibration::Tool> X_HT;     ///< how the handle holds the tool
  bool realtime = true;                                               ///< ask for priority, a core, locked memory
};

/// The command with its limits cut down to what the device can give and hold at this rate: peak force and torque, and
/// slopes no steeper than nine tenths of the stiffest wall. Record this one: a replay has no device.
Command limitedTo(const DeviceCapabilities& device, double rate_Hz, const Command& command);

class HapticLoop final : private DeviceServo {
 public:
  /// Throws DeviceError when the rate is outside 500..10000 Hz or a pose is not finite and rigid.
  HapticLoop(Servo& servo, HapticDevice& device, Latest<Command>& commands, TickLog& log, Latest<Tick>& newest,
             const LoopSettings& settings);
  ~HapticLoop() override;
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;

  /// Once in its life (assert). Throws DeviceError when the device has gone or can not be served at the rate.
  void start();
  /// Lets the force down to zero at the slew limit, then stops the device: a frame of no force, then motors off.
  void stop() noexcept;
  /// No force from this moment on, motors off for good; the ticks go on. Lock-free but for what the device needs.
  void emergencyStop() noexcept;

  ServoFigures figures() const;

 private:
  enum class Phase { serving, letting_go, over };

  void begin() noexcept override;
  MotorCommand tick(const HandleState& state, const Beat& beat) noexcept override;
  MotorCommand letGo() noexcept;
  HandSample handFrom(const HandleState& state) noexcept;
  Wrench<calibration::Device> inDevice(const Wrench<calibration::Patient>& wrench_P) const;

  Servo& servo_;
  HapticDevice& device_;
  Latest<Command>& commands_;
  TickLog& log_;
  Latest<Tick>& newest_;
  LoopSettings settings_;
  calibration::Pose<calibration::Device, calibration::Patient> X_DP_;
  MotorGate gate_;
  ServoStatistics statistics_;
  std::atomic<std::uint64_t> ticks_{0};
  std::optional<Supervisor> supervisor_;
  bool started_ = false;  ///< of the thread that starts and stops
  std::atomic<Phase> phase_{Phase::serving};

  // Of the device's thread: the force that goes down at the end, and what turning adds to the tool's velocity.
  MotorCommand last_;
  double share_left_ = 1.0;
  glm::dvec3 last_arm_P_mm_{0.0}, arm_velocity_P_mm_per_s_{0.0};
  bool has_arm_ = false;
};

}  // namespace haptics
