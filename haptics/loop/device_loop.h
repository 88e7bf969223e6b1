// A device at work: it ticks on its own thread, every tick asks for a wrench, and what the motor gate admits of it goes
// back. Watches that ticks come, measures how punctual they are, lets the force down gently at the end. Who derives
// says what is wanted. start() and stop() from one thread, emergencyStop() from any. Real-time priority, a core and
// locked memory are asked for and reported; they are not required. Runs once: start, stop, and no second start. By hand
// (served_device) there is no thread, no supervisor and no clock: step() makes the ticks. What derives must stop() in
// its own destructor. Not the safety layer: that is the business of who answers.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "haptics/device/haptic_device.h"
#include "haptics/loop/loop_statistics.h"
#include "haptics/loop/served_device.h"
#include "haptics/loop/supervisor.h"
#include "haptics/safety/motor_gate.h"

namespace haptics {

class DeviceLoop : private DeviceServo {
 public:
  /// Borrows the device. `priority`: SCHED_FIFO's that its thread asks for, with a core and locked memory; none: for
  /// none of them. Throws DeviceError when the rate is outside 500..10000 Hz.
  DeviceLoop(ServedDevice served, double rate_Hz, std::optional<int> priority);
  ~DeviceLoop() override;
  DeviceLoop(const DeviceLoop&) = delete;
  DeviceLoop& operator=(const DeviceLoop&) = delete;

  /// Once in its life (assert). Throws DeviceError when the device has gone or can not be served at the rate.
  void start();
  /// Lets the force down to zero within 0.02 s, at once after a pause or under a device in trouble; then stops the
  /// device: a frame of no force, then motors off.
  void stop() noexcept;

  /// By hand alone, between start() and stop(), on their thread: so many ticks; and time in which none comes.
  void step(std::uint64_t ticks) noexcept { stepped_->step(ticks); }
  void pass(std::chrono::nanoseconds time) noexcept { stepped_->pass(time); }

  /// No force from this moment on, for good; the ticks go on. Only atomics: a signal handler may call it.
  void disableForce() noexcept { gate_.shut(); }
  /// That, and motors off at once. Any thread.
  void emergencyStop() noexcept;
  bool isForceDisabled() const noexcept { return gate_.isShut(); }

  /// So far. Any thread, signal handlers too.
  std::uint64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }
  /// How often the supervisor has switched the motors off, for want of ticks.
  std::uint64_t watchdogTrips() const noexcept { return supervisor_ ? supervisor_->trips() : 0; }
  LoopFigures figures() const;

 protected:
  struct Answer {
    Wrench<calibration::Device> wrench_D;
    bool motors_on = true;
  };
  /// The device's thread, once a tick; bounded.
  virtual Answer answer(const HandleState& state, const TickTiming& timing) noexcept = 0;
  /// After each answer, with the CPU time it took; by hand none is measured.
  virtual void answered(double /*work_us*/) noexcept {}

  const DeviceCapabilities& device() const { return capabilities_; }
  double rate_Hz() const { return rate_Hz_; }
  /// Of the clock that the ticks go by. By hand: of the thread that steps.
  std::int64_t now_ns() const noexcept;

 private:
  enum class Phase { serving, letting_go, over };

  void begin() noexcept override;
  MotorCommand tick(const HandleState& state, const TickTiming& timing) noexcept override;
  MotorCommand letGo(const HandleState& state, const TickTiming& timing) noexcept;
  void awaitGoodbye() noexcept;
  double gap_s(const TickTiming& timing) noexcept;

  HapticDevice& device_;
  SimulatedDevice* const stepped_;
  const DeviceCapabilities& capabilities_;
  const double rate_Hz_;
  const std::optional<int> priority_;
  MotorGate gate_;
  LoopStatistics statistics_;
  std::atomic<std::uint64_t> ticks_{0};
  std::optional<Supervisor> supervisor_;
  bool started_ = false;  ///< of the thread that starts and stops
  std::atomic<Phase> phase_{Phase::serving};

  // Of the device's thread.
  MotorCommand last_;
  double share_left_ = 1.0;
  std::optional<std::int64_t> last_tick_ns_;
};

}  // namespace haptics
