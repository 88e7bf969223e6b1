#include "haptics/loop/device_loop.h"

#include <time.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "haptics/device/monotonic_clock.h"
#include "haptics/safety/safety_limits.h"

namespace haptics {
namespace {

/// The largest rates of force and torque (safety/safety_limits).
constexpr double kRampDown_N_per_s = 300.0, kRampDown_Nmm_per_s = 15'000.0;
/// Limit of the wait for the ramp; a device without ticks is stopped without.
constexpr auto kMaxRampDown = std::chrono::milliseconds(200);

/// Periods between two ticks that are not a gap.
constexpr double kMaxPunctual = 1.5;

double threadTime_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

}  // namespace

DeviceLoop::DeviceLoop(ServedDevice served, double rate_Hz, std::optional<int> priority)
    : device_(served.device),
      stepped_(served.stepped),
      capabilities_(device_.capabilities()),
      rate_Hz_(rate_Hz),
      priority_(stepped_ == nullptr ? priority : std::nullopt),
      gate_(capabilities_) {
  if (!(rate_Hz >= 500.0 && rate_Hz <= 10'000.0))
    throw DeviceError("servo rate, " + std::to_string(std::lround(rate_Hz)) + " Hz, choose one from 500 to 10000 Hz");
}

DeviceLoop::~DeviceLoop() { assert(!started_ || phase_.load() != Phase::running); }

void DeviceLoop::start() {
  assert(!started_);
  if (stepped_ != nullptr)
    stepped_->startStepped(*this, rate_Hz_);
  else
    device_.start(*this, rate_Hz_);
  // Not set if start() throws: there is no force to ramp down.
  started_ = true;
  if (stepped_ == nullptr) supervisor_.emplace(device_, ticks_);
}

void DeviceLoop::stop() noexcept {
  Phase running = Phase::running;
  if (started_ && phase_.compare_exchange_strong(running, Phase::ramping_down)) awaitRampDown();
  if (supervisor_) supervisor_->end();
  device_.stop();
}

void DeviceLoop::awaitRampDown() noexcept {
  if (stepped_ != nullptr) {
    // Counted in steps: a stopped device has neither ticks nor time.
    auto steps = static_cast<std::int64_t>(std::ceil(std::chrono::duration<double>(kMaxRampDown).count() * rate_Hz_));
    for (; steps > 0 && phase_.load() != Phase::stopped; --steps) stepped_->step(1);
    return;
  }
  const std::int64_t until_ns = now_ns() + std::chrono::nanoseconds(kMaxRampDown).count();
  while (phase_.load() != Phase::stopped && now_ns() < until_ns)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::int64_t DeviceLoop::now_ns() const noexcept {
  return stepped_ != nullptr ? stepped_->steppedTime_ns() : monotonic_ns();
}

void DeviceLoop::emergencyStop() noexcept {
  disableForce();
  device_.motorsOff();
}

LoopFigures DeviceLoop::figures() const {
  LoopFigures figures = statistics_.figures();
  figures.watchdog_trips = watchdogTrips();
  return figures;
}

void DeviceLoop::begin() noexcept {
  if (priority_) statistics_.setGrants(requestRealtime(*priority_));
}

MotorCommand DeviceLoop::tick(const HandleState& state, const TickTiming& timing) noexcept {
  ticks_.fetch_add(1, std::memory_order_relaxed);
  if (phase_.load(std::memory_order_relaxed) != Phase::running) return rampDown(state, timing);

  const double began_us = stepped_ != nullptr ? 0.0 : threadTime_us();
  TickTiming timed = timing;
  const double since_s = gap_s(timing);
  // A late tick of a simulated world is no gap: nobody moved meanwhile.
  const bool is_gap = since_s * rate_Hz_ > kMaxPunctual && !capabilities_.pauses_with_ticks;
  timed.gap_s = is_gap ? since_s : 0.0;
  const Answer request = answer(state, timed);
  last_ = gate_.admit(request.wrench_D, state.jacobian_D_mm, request.motors_on);
  const double work_us = stepped_ != nullptr ? 0.0 : threadTime_us() - began_us;
  answered(work_us);
  statistics_.add(work_us, 1e6 / rate_Hz_, timing.late_us);
  statistics_.addMissed(timing.missed);
  return last_;
}

double DeviceLoop::gap_s(const TickTiming& timing) noexcept {
  const std::int64_t last_ns = std::exchange(last_tick_ns_, timing.at_ns).value_or(timing.at_ns);
  return 1e-9 * static_cast<double>(timing.at_ns - last_ns);
}

MotorCommand DeviceLoop::rampDown(const HandleState& state, const TickTiming& timing) noexcept {
  // A force ended by a pause or the supervisor is not ramped.
  if (gap_s(timing) > SafetyThresholds{}.max_pause_s || !state.healthy) ramp_share_ = 0.0;
  // Force and torque fall together, the slower one at its limit.
  const Wrench<calibration::Device>& wrench = last_.wrench_D();
  const double seconds = std::max(glm::length(wrench.force_N.xyz) / kRampDown_N_per_s,
                                  glm::length(wrench.torque_Nmm.xyz) / kRampDown_Nmm_per_s);
  ramp_share_ = seconds > 0.0 ? std::max(0.0, ramp_share_ - 1.0 / (rate_Hz_ * seconds)) : 0.0;
  if (ramp_share_ > 0.0 && !gate_.isShut()) return last_.scaled(ramp_share_);
  phase_.store(Phase::stopped, std::memory_order_relaxed);
  return {};
}

}  // namespace haptics
