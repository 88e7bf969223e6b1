// Runs a device: it ticks on its own thread, every tick computes a wrench, and the motor gate passes it on. Watches
// that ticks come, measures their timing, ramps the force down at the end. A derived class gives the wrench and must
// stop() in its destructor. start() and stop() from one thread, emergencyStop() from any. Real-time priority, a core
// and locked memory are requested and reported, not required. One start and one stop. A stepped device (served_device)
// has no thread, supervisor or clock: step() makes the ticks. The safety layer is
// not included: the derived class adds it.
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
  /// Borrows the device. `priority`: SCHED_FIFO priority of its thread, requested with a core and locked memory; none:
  /// no request. Throws DeviceError if the rate is outside 500..10000 Hz.
  DeviceLoop(ServedDevice served, double rate_Hz, std::optional<int> priority);
  ~DeviceLoop() override;
  DeviceLoop(const DeviceLoop&) = delete;
  DeviceLoop& operator=(const DeviceLoop&) = delete;

  /// Once (assert). Throws DeviceError if the device has gone or cannot run at the rate.
  void start();
  /// Ramps the force to zero within 0.02 s, at once after a pause or for an unhealthy device; then stops the device: a
  /// frame of zero force, then motors off.
  void stop() noexcept;

  /// Stepped devices, between start() and stop(), on their thread: make ticks; let time pass without ticks.
  void step(std::uint64_t ticks) noexcept { stepped_->step(ticks); }
  void pass(std::chrono::nanoseconds time) noexcept { stepped_->pass(time); }

  /// No force from now on; ticks continue. Only atomics: a signal handler may call it.
  void disableForce() noexcept { gate_.shut(); }
  /// The same, and motors off at once. Any thread.
  void emergencyStop() noexcept;
  bool isForceDisabled() const noexcept { return gate_.isShut(); }

  /// So far. Any thread, signal handlers too.
  std::uint64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }
  /// How often the supervisor switched the motors off because no tick came.
  std::uint64_t watchdogTrips() const noexcept { return supervisor_ ? supervisor_->trips() : 0; }
  LoopFigures figures() const;

 protected:
  struct Answer {
    Wrench<calibration::Device> wrench_D;
    bool motors_on = true;
  };
  /// Device thread, once a tick; bounded.
  virtual Answer answer(const HandleState& state, const TickTiming& timing) noexcept = 0;
  /// After each answer, with its CPU time; 0 for a stepped device.
  virtual void answered(double /*work_us*/) noexcept {}

  const DeviceCapabilities& device() const { return capabilities_; }
  double rate_Hz() const { return rate_Hz_; }
  /// The clock of the ticks. Stepped devices: the stepping thread alone.
  std::int64_t now_ns() const noexcept;

 private:
  enum class Phase { running, ramping_down, stopped };

  void begin() noexcept override;
  MotorCommand tick(const HandleState& state, const TickTiming& timing) noexcept override;
  MotorCommand rampDown(const HandleState& state, const TickTiming& timing) noexcept;
  void awaitRampDown() noexcept;
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
  bool started_ = false;  ///< of the starting thread
  std::atomic<Phase> phase_{Phase::running};

  // Device thread.
  MotorCommand last_;
  double ramp_share_ = 1.0;
  std::optional<std::int64_t> last_tick_ns_;
};

}  // namespace haptics
