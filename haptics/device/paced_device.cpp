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

void PacedDevice::start(DeviceServo& servo, double rate_Hz) {
  assert(!started_);
  const DeviceCapabilities& can = capabilities();
  if (!(rate_Hz >= can.least_rate_Hz && rate_Hz <= can.most_rate_Hz))
    throw DeviceError(can.model + ": it is not served at " + std::to_string(std::lround(rate_Hz)) +
                      " Hz, choose from " + std::to_string(std::lround(can.least_rate_Hz)) + " to " +
                      std::to_string(std::lround(can.most_rate_Hz)) + " Hz");
  started_ = true;
  running_.store(true);
  thread_ = std::thread([this, &servo, rate_Hz] { run(servo, rate_Hz); });
}

void PacedDevice::stop() noexcept {
  running_.store(false);
  if (thread_.joinable()) thread_.join();
}

void PacedDevice::await(std::int64_t deadline_ns) noexcept {
  const timespec t{static_cast<time_t>(deadline_ns / kNsPerSecond), static_cast<long>(deadline_ns % kNsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

void PacedDevice::run(DeviceServo& servo, double rate_Hz) noexcept {
  servo.begin();
  const double dt_s = 1.0 / rate_Hz;
  const auto period_ns = static_cast<std::int64_t>(std::llround(dt_s * static_cast<double>(kNsPerSecond)));
  std::int64_t deadline_ns = monotonic_ns() + period_ns;
  Beat beat;
  while (running_.load(std::memory_order_relaxed)) {
    await(deadline_ns);
    const std::int64_t woke_ns = monotonic_ns();
    beat.late_us = std::max(0.0, 1e-3 * static_cast<double>(woke_ns - deadline_ns));
    deadline_ns = std::min(deadline_ns, woke_ns);

    // Switched off while it was made, a command is void.
    const std::uint32_t times_off = times_off_.load();
    const MotorCommand command = servo.tick(sense(dt_s), beat);
    drive(times_off_.load() == times_off ? command : MotorCommand{});

    // The next deadline of the grid that still lies ahead.
    deadline_ns += period_ns;
    const std::int64_t behind_ns = monotonic_ns() - deadline_ns;
    beat.missed = behind_ns > 0 ? static_cast<std::uint64_t>(behind_ns / period_ns + 1) : 0;
    deadline_ns += static_cast<std::int64_t>(beat.missed) * period_ns;
  }
  drive(MotorCommand{});
}

}  // namespace haptics
