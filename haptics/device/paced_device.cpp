#include "haptics/device/paced_device.h"

#include <time.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>

#include "haptics/device/monotonic_clock.h"

namespace haptics {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

}  // namespace

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
  by_hand_ = true;
  servo.begin();
  grid_.emplace(rate_Hz, by_hand_ns_);
}

void PacedDevice::stop() noexcept {
  const bool was_running = running_.exchange(false);
  if (thread_.joinable()) thread_.join();
  if (by_hand_ && was_running) drive(MotorCommand{});
}

std::int64_t PacedDevice::now_ns() const noexcept { return by_hand_ ? by_hand_ns_ : monotonic_ns(); }

void PacedDevice::await(std::int64_t deadline_ns) noexcept {
  const timespec t{static_cast<time_t>(deadline_ns / kNsPerSecond), static_cast<long>(deadline_ns % kNsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

void PacedDevice::run() noexcept {
  servo_->begin();
  grid_.emplace(rate_Hz_, monotonic_ns());
  while (running_.load(std::memory_order_relaxed)) {
    await(grid_->next_ns());
    turn();
  }
  drive(MotorCommand{});
}

void PacedDevice::step(std::uint64_t ticks) noexcept {
  assert(by_hand_);
  for (; ticks > 0 && running_.load(std::memory_order_relaxed); --ticks) {
    by_hand_ns_ = std::max(by_hand_ns_, grid_->next_ns());
    turn();
  }
}

void PacedDevice::turn() noexcept {
  TickTiming timing = grid_->woke(now_ns());
  // Switched off while it was made, a command is void.
  const std::uint32_t times_off = off_requests_.load();
  const HandleState state = sense(1.0 / rate_Hz_);
  timing.at_ns = now_ns();
  const MotorCommand command = servo_->tick(state, timing);
  drive(off_requests_.load() == times_off ? command : MotorCommand{});
  grid_->ticked(now_ns());
}

}  // namespace haptics
