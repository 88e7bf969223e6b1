// A device without a clock of its own: a thread wakes on absolute deadlines, senses, asks the servo, drives. After a
// long pre-emption it runs one tick, takes the next deadline of the old grid and says how many it passed over. Base of
// every backend but those with a scheduler of their own. What derives must stop() in its own destructor: the thread
// calls it.
#pragma once

#include <atomic>
#include <thread>

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
  void motorsOff() noexcept override { times_off_.fetch_add(1); }

 protected:
  /// The device's thread, once a tick; bounded, no lock, no allocation.
  virtual HandleState sense(double dt_s) noexcept = 0;
  virtual void drive(const MotorCommand& command) noexcept = 0;
  /// Until `deadline_ns` of CLOCK_MONOTONIC. A device that speaks by itself may come back as soon as it has spoken: the
  /// next deadline is a period from then.
  virtual void await(std::int64_t deadline_ns) noexcept;

 private:
  void run(DeviceServo& servo, double rate_Hz) noexcept;

  std::atomic<bool> running_{false};
  std::atomic<std::uint32_t> times_off_{0};
  std::thread thread_;
  bool started_ = false;
};

}  // namespace haptics
