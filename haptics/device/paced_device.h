// Base of the devices without a scheduler of their own: a thread wakes on absolute deadlines, senses, calls the servo,
// drives. After a long pre-emption it runs one tick, takes the next deadline of the old grid and reports how many were
// missed. The same ticks can be stepped instead, on the caller's thread and in a time that only they advance. A
// subclass must call stop() in its own destructor: the thread calls its functions.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "haptics/device/deadline_grid.h"
#include "haptics/device/haptic_device.h"

namespace haptics {

class PacedDevice : public HapticDevice {
 public:
  PacedDevice() = default;
  ~PacedDevice() override;
  PacedDevice(const PacedDevice&) = delete;
  PacedDevice& operator=(const PacedDevice&) = delete;

  void start(DeviceServo& servo, double rate_Hz) override;
  void stop() noexcept override;
  void motorsOff() noexcept override { off_requests_.fetch_add(1); }

 protected:
  /// The device's thread, once a tick; bounded, no lock, no allocation.
  virtual HandleState sense(double dt_s) noexcept = 0;
  virtual void drive(const MotorCommand& command) noexcept = 0;
  /// Until `deadline_ns` of CLOCK_MONOTONIC. A device with reports of its own may return at once when one came: the
  /// next deadline is a period from then.
  virtual void await(std::int64_t deadline_ns) noexcept;

  /// Instead of start(): no thread and no clock, step() makes the ticks.
  void startStepped(DeviceServo& servo, double rate_Hz);
  /// Each tick at its deadline, unless pass() went beyond it.
  void step(std::uint64_t ticks) noexcept;
  /// Stepped only: time in which no tick happens.
  void pass(std::chrono::nanoseconds time) noexcept { stepped_ns_ += time.count(); }
  /// Stepped only: the present time.
  std::int64_t steppedTime_ns() const noexcept { return stepped_ns_; }

 private:
  std::int64_t now_ns() const noexcept;
  void prepare(DeviceServo& servo, double rate_Hz);
  void run() noexcept;
  void tick() noexcept;

  std::atomic<bool> running_{false};
  std::atomic<std::uint32_t> off_requests_{0};
  std::thread thread_;
  bool started_ = false, is_stepped_ = false;

  // Of the thread of the ticks.
  DeviceServo* servo_ = nullptr;
  double rate_Hz_ = 0.0;
  std::int64_t stepped_ns_ = 0;
  std::optional<DeadlineGrid> grid_;
};

}  // namespace haptics
