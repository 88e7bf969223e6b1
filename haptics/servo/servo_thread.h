// The servo's own thread: device in, Servo::step, device out, at a steady rate on absolute deadlines. Owns nothing it
// serves; everything it borrows must outlive it and must not be restructured while it runs. Values cross by Latest and
// TickLog alone. start() and stop() from one other thread. SCHED_FIFO and locked memory are asked for, and it is
// reported whether they were granted; they are not required. After a long pre-emption it runs one tick, takes the next
// deadline of the old grid and counts those it passed over. Simulated time is the sum of the ticks' dt whatever the
// clock does, so a replay needs no clock. Runs once: start, stop, and no second start.
#pragma once

#include <atomic>
#include <thread>

#include "haptics/device/haptic_device.h"
#include "haptics/latest.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/servo_statistics.h"
#include "haptics/servo/tick_log.h"

namespace haptics {

struct ServoSettings {
  double rate_Hz = 1000.0;                                            ///< 500..10000
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;  ///< where the device stands
  calibration::Pose<calibration::Handle, calibration::Tool> X_HT;     ///< how the handle holds the tool
  bool realtime = true;                                               ///< ask for SCHED_FIFO and mlockall
};

/// The command with its limits cut down to what the device can give and hold at this rate: peak force and torque, and
/// slopes no steeper than nine tenths of the stiffest wall. Record this one: a replay has no device.
Command limitedTo(const DeviceCapabilities& device, double rate_Hz, const Command& command);

class ServoThread {
 public:
  /// Throws DeviceError when the rate is outside 500..10000 Hz or a pose is not finite and rigid.
  ServoThread(Servo& servo, HapticDevice& device, Latest<Command>& commands, TickLog& log, Latest<Tick>& newest,
              const ServoSettings& settings);
  ~ServoThread();
  ServoThread(const ServoThread&) = delete;
  ServoThread& operator=(const ServoThread&) = delete;

  /// Once in its life (assert): the servo's safety filter holds the last force, which a second start would leap to.
  void start();
  /// Lets the force down to zero at the slew limit, then ends the thread.
  void stop();
  ServoFigures figures() const { return statistics_.figures(); }

 private:
  void run() noexcept;
  HandSample handFrom(const HandleState& state) noexcept;

  Servo& servo_;
  HapticDevice& device_;
  Latest<Command>& commands_;
  TickLog& log_;
  Latest<Tick>& newest_;
  ServoSettings settings_;
  ServoStatistics statistics_;
  bool started_ = false;  ///< of the thread that starts and stops
  std::atomic<bool> running_{false};
  std::thread thread_;

  // Of the running thread: the force on its way to the hand, and what turning adds to the tool's velocity.
  Wrench<calibration::Patient> wrench_P_;  ///< torque about the handle
  glm::dvec3 last_arm_P_mm_{0.0}, arm_velocity_P_mm_per_s_{0.0};
  bool has_arm_ = false;
};

}  // namespace haptics
