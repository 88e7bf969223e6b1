// A device without a clock of its own: a thread wakes on absolute deadlines, senses, asks the servo, drives. After a
// long pre-emption it runs one tick, takes the next deadline of the old grid and says how many it passed over. Base of
// every backend but those with a scheduler of their own. The same ticks can be stepped by hand, on the caller's thread
// and in a time that only they move. What derives must stop() in its own destructor: the thread calls it.
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
  /// Until `deadline_ns` of CLOCK_MONOTONIC. A device that speaks by itself may come back as soon as it has spoken: the
  /// next deadline is a period from then.
  virtual void await(std::int64_t deadline_ns) noexcept;

  /// Instead of start(): no thread and no clock, the ticks are step()'s.
  void startStepped(DeviceServo& servo, double rate_Hz);
  /// So many ticks, each at its deadline unless time went by.
  void step(std::uint64_t ticks) noexcept;
  /// By hand alone: time in which no tick comes.
  void pass(std::chrono::nanoseconds time) noexcept { by_hand_ns_ += time.count(); }
  /// By hand alone: as far as ticks and passing time have come.
  std::int64_t steppedTime_ns() const noexcept { return by_hand_ns_; }

 private:
  std::int64_t now_ns() const noexcept;
  void prepare(DeviceServo& servo, double rate_Hz);
  void run() noexcept;
  void turn() noexcept;

  std::atomic<bool> running_{false};
  std::atomic<std::uint32_t> off_requests_{0};
  std::thread thread_;
  bool started_ = false, by_hand_ = false;

  // Of the device's thread, or of whoever steps it.
  DeviceServo* servo_ = nullptr;
  double rate_Hz_ = 0.0;
  std::int64_t by_hand_ns_ = 0;
  std::optional<DeadlineGrid> grid_;
};

}  // namespace haptics
