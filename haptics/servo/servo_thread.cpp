#include "haptics/servo/servo_thread.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/contact/law_limits.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::Patient;

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t now_ns(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return std::int64_t{t.tv_sec} * kNsPerSecond + t.tv_nsec;
}

void sleepUntil(std::int64_t deadline_ns) {
  const timespec t{static_cast<time_t>(deadline_ns / kNsPerSecond), static_cast<long>(deadline_ns % kNsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

template <class A, class B>
bool rigid(const calibration::Pose<A, B>& X) {
  const double norm = glm::dot(X.rotation, X.rotation);
  return std::isfinite(norm) && std::abs(norm - 1.0) < 1e-6 && std::isfinite(glm::length(X.translation_mm));
}

bool askForRealtime() {
  sched_param param{};
  param.sched_priority = std::max(sched_get_priority_min(SCHED_FIFO), sched_get_priority_max(SCHED_FIFO) - 10);
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
}

}  // namespace

Command limitedTo(const DeviceCapabilities& device, double rate_Hz, const Command& command) {
  const auto at_most = [](double value, double most) {
    return std::min(value, std::isfinite(most) ? std::max(0.0, most) : 0.0);
  };
  Command limited = command;
  SafetyLimits& safety = limited.safety;
  safety = sanitised(command.safety);
  safety.peak_force_N = at_most(safety.peak_force_N, device.peak_force_N);
  safety.peak_torque_Nmm = at_most(safety.peak_torque_Nmm, device.peak_torque_Nmm);
  safety.most_stiffness_N_per_mm =
      at_most(safety.most_stiffness_N_per_mm,
              0.9 * passiveStiffness_N_per_mm(device.damping_Ns_per_mm, command.law.damping_Ns_per_mm, 1.0 / rate_Hz));
  return limited;
}

ServoThread::ServoThread(Servo& servo, HapticDevice& device, Latest<Command>& commands, TickLog& log,
                         Latest<Tick>& newest, const ServoSettings& settings)
    : servo_(servo), device_(device), commands_(commands), log_(log), newest_(newest), settings_(settings) {
  if (!(settings.rate_Hz >= 500.0 && settings.rate_Hz <= 10'000.0))
    throw DeviceError("servo rate, " + std::to_string(settings.rate_Hz) + " Hz, choose one from 500 to 10000 Hz");
  if (!rigid(settings.X_PD)) throw DeviceError("pose of the device, not finite and rigid, calibrate the rig again");
  if (!rigid(settings.X_HT))
    throw DeviceError("pose of the tool in the handle, not finite and rigid, measure it again");
}

ServoThread::~ServoThread() { stop(); }

void ServoThread::start() {
  assert(!started_);
  started_ = true;
  running_.store(true);
  thread_ = std::thread([this] { run(); });
}

void ServoThread::stop() {
  running_.store(false);
  if (thread_.joinable()) thread_.join();
}

HandSample ServoThread::handFrom(const HandleState& state) noexcept {
  HandSample hand;
  const auto X_PH = settings_.X_PD * state.X_DH;
  hand.X_PT = X_PH * settings_.X_HT;
  hand.drill_pedal = state.pedal;
  hand.device_healthy = state.healthy;

  // The device measures the handle's velocity; turning moves the tool's tip too, differenced and smoothed at 100 Hz.
  const glm::dvec3 arm_P_mm = X_PH.rotation * settings_.X_HT.translation_mm;
  const double blend = 1.0 - std::exp(-2.0 * calibration::kPi * 100.0 / settings_.rate_Hz);
  const glm::dvec3 difference = has_arm_ ? (arm_P_mm - last_arm_P_mm_) * settings_.rate_Hz : glm::dvec3(0.0);
  arm_velocity_P_mm_per_s_ += blend * (difference - arm_velocity_P_mm_per_s_);
  if (!std::isfinite(glm::length(arm_velocity_P_mm_per_s_))) arm_velocity_P_mm_per_s_ = glm::dvec3(0.0);
  last_arm_P_mm_ = arm_P_mm;
  has_arm_ = std::isfinite(glm::length(arm_P_mm));
  hand.arm_P_mm.xyz = -arm_P_mm;
  hand.velocity_P_mm_per_s = settings_.X_PD * state.velocity_D_mm_per_s;
  hand.velocity_P_mm_per_s.xyz += arm_velocity_P_mm_per_s_;
  return hand;
}

void ServoThread::run() noexcept {
  statistics_.setGrants(settings_.realtime && askForRealtime(),
                        settings_.realtime && mlockall(MCL_CURRENT | MCL_FUTURE) == 0);
  const auto X_DP = settings_.X_PD.inverse();
  const auto in_device = [&] { return Wrench<Device>{X_DP * wrench_P_.force_N, X_DP * wrench_P_.torque_Nmm}; };
  const DeviceCapabilities capabilities = device_.capabilities();
  const double dt_s = 1.0 / settings_.rate_Hz;
  const auto period_ns = static_cast<std::int64_t>(std::llround(dt_s * static_cast<double>(kNsPerSecond)));

  std::int64_t deadline_ns = now_ns(CLOCK_MONOTONIC) + period_ns;
  while (running_.load(std::memory_order_relaxed)) {
    sleepUntil(deadline_ns);
    const std::int64_t late_ns = now_ns(CLOCK_MONOTONIC) - deadline_ns;

    // Last tick's force out, this tick's hand in; then the step.
    const std::int64_t began_ns = now_ns(CLOCK_THREAD_CPUTIME_ID);
    const HandSample hand = handFrom(device_.exchange(in_device(), dt_s));
    Tick tick = servo_.step(hand, limitedTo(capabilities, settings_.rate_Hz, commands_.read()), dt_s);
    wrench_P_ = {tick.served_force_P_N, tick.served_torque_P_Nmm};
    tick.work_us = static_cast<float>(static_cast<double>(now_ns(CLOCK_THREAD_CPUTIME_ID) - began_ns) * 1e-3);
    log_.push(tick);
    newest_.publish(tick);
    statistics_.add(static_cast<double>(tick.work_us), static_cast<double>(late_ns) * 1e-3);

    // The next deadline of the grid that still lies ahead.
    deadline_ns += period_ns;
    const std::int64_t behind_ns = now_ns(CLOCK_MONOTONIC) - deadline_ns;
    if (behind_ns > 0) {
      const std::int64_t passed = behind_ns / period_ns + 1;
      statistics_.addMissed(static_cast<std::uint64_t>(passed));
      deadline_ns += passed * period_ns;
    }
  }

  // Let go gently.
  const SafetyLimits limits = sanitised(commands_.read().safety);
  const double ticks = std::ceil(std::max(glm::length(wrench_P_.force_N.xyz) / (limits.slew_N_per_s * dt_s),
                                          glm::length(wrench_P_.torque_Nmm.xyz) / (limits.slew_Nmm_per_s * dt_s)));
  const Wrench<Patient> last_P = wrench_P_;
  for (double left = ticks; left > 0.0; left -= 1.0) {
    wrench_P_ = ((left - 1.0) / ticks) * last_P;
    device_.exchange(in_device(), dt_s);
    deadline_ns += period_ns;
    sleepUntil(deadline_ns);
  }
}

}  // namespace haptics
