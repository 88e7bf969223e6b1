#include "haptics/device/paced_device.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "haptics/device/monotonic_clock.h"

namespace haptics {

PacedDevice::~PacedDevice() { assert(!thread_.joinable()); }

void PacedDevice::prepare(DeviceServo& servo, double rate_Hz) {
  assert(!started_);
  const DeviceCapabilities& can = capabilities();
  if (!(rate_Hz >= can.min_rate_Hz && rate_Hz <= can.max_rate_Hz))
    throw DeviceError(can.model + ": it is not served at " + std::to_string(std::lround(rate_Hz)) +
                      " Hz, choose from " + std::to_string(std::lround(can.min_rate_Hz)) + " to " +
                      std::to_string(std::lround(can.max_rate_Hz)) + " Hz");
  started_ = true;
  servo_ = &servo;
  rate_Hz_ = rate_Hz;
  running_.store(true);
}

void PacedDevice::start(DeviceServo& servo, double rate_Hz) {
  prepare(servo, rate_Hz);
  thread_ = std::thread([this] { run(); });
}

void PacedDevice::startStepped(DeviceServo& servo, double rate_Hz) {
  prepare(servo, rate_Hz);
  is_stepped_ = true;
  servo.begin();
  grid_.emplace(rate_Hz, stepped_ns_);
}

void PacedDevice::stop() noexcept {
  const bool was_running = running_.exchange(false);
  if (thread_.joinable()) thread_.join();
  if (is_stepped_ && was_running) drive(MotorCommand{});
}

std::int64_t PacedDevice::now_ns() const noexcept { return is_stepped_ ? stepped_ns_ : monotonic_ns(); }

void PacedDevice::await(std::int64_t deadline_ns) noexcept { sleepUntil(deadline_ns); }

void PacedDevice::run() noexcept {
  servo_->begin();
  grid_.emplace(rate_Hz_, monotonic_ns());
  while (running_.load(std::memory_order_relaxed)) {
    await(grid_->next_ns());
    tick();
  }
  drive(MotorCommand{});
}

void PacedDevice::step(std::uint64_t ticks) noexcept {
  assert(is_stepped_);
  for (; ticks > 0 && running_.load(std::memory_order_relaxed); --ticks) {
    stepped_ns_ = std::max(stepped_ns_, grid_->next_ns());
    tick();
  }
}

void PacedDevice::tick() noexcept {
  TickTiming timing = grid_->beginTick(now_ns());
  // A command is void if the motors were switched off while it was made.
  const std::uint32_t off_requests = off_requests_.load();
  const HandleState state = sense(1.0 / rate_Hz_);
  timing.at_ns = now_ns();
  const MotorCommand command = servo_->tick(state, timing);
  drive(off_requests_.load() == off_requests ? command : MotorCommand{});
  grid_->endTick(now_ns());
}

}  // namespace haptics
