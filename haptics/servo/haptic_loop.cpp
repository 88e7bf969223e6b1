#include "haptics/servo/haptic_loop.h"

#include <time.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/contact/law_limits.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::Patient;

/// Longest wait for a device that lets go; one that does not tick is stopped without.
constexpr auto kLongestGoodbye = std::chrono::milliseconds(200);

double threadTime_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

template <class A, class B>
bool rigid(const calibration::Pose<A, B>& X) {
  const double norm = glm::dot(X.rotation, X.rotation);
  return std::isfinite(norm) && std::abs(norm - 1.0) < 1e-6 && std::isfinite(glm::length(X.translation_mm));
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

HapticLoop::HapticLoop(Servo& servo, HapticDevice& device, Latest<Command>& commands, TickLog& log,
                       Latest<Tick>& newest, const LoopSettings& settings)
    : servo_(servo),
      device_(device),
      commands_(commands),
      log_(log),
      newest_(newest),
      settings_(settings),
      X_DP_(settings.X_PD.inverse()),
      gate_(device.capabilities()) {
  if (!(settings.rate_Hz >= 500.0 && settings.rate_Hz <= 10'000.0))
    throw DeviceError("servo rate, " + std::to_string(settings.rate_Hz) + " Hz, choose one from 500 to 10000 Hz");
  if (!rigid(settings.X_PD)) throw DeviceError("pose of the device, not finite and rigid, calibrate the rig again");
  if (!rigid(settings.X_HT))
    throw DeviceError("pose of the tool in the handle, not finite and rigid, measure it again");
}

HapticLoop::~HapticLoop() { stop(); }

void HapticLoop::start() {
  assert(!started_);
  started_ = true;
  device_.start(*this, settings_.rate_Hz);
  supervisor_.emplace(device_, ticks_);
}

void HapticLoop::stop() noexcept {
  Phase serving = Phase::serving;
  if (started_ && phase_.compare_exchange_strong(serving, Phase::letting_go)) {
    const auto until = std::chrono::steady_clock::now() + kLongestGoodbye;
    while (phase_.load() != Phase::over && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  supervisor_.reset();
  device_.stop();
}

void HapticLoop::emergencyStop() noexcept {
  gate_.shut();
  device_.motorsOff();
}

ServoFigures HapticLoop::figures() const {
  ServoFigures figures = statistics_.figures();
  figures.silences = supervisor_ ? supervisor_->trips() : 0;
  return figures;
}

void HapticLoop::begin() noexcept {
  if (settings_.realtime) statistics_.setGrants(askForRealtime());
}

Wrench<Device> HapticLoop::inDevice(const Wrench<Patient>& wrench_P) const {
  return {X_DP_ * wrench_P.force_N, X_DP_ * wrench_P.torque_Nmm};
}

HandSample HapticLoop::handFrom(const HandleState& state) noexcept {
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

MotorCommand HapticLoop::tick(const HandleState& state, const Beat& beat) noexcept {
  ticks_.fetch_add(1, std::memory_order_relaxed);
  if (phase_.load(std::memory_order_relaxed) != Phase::serving) return letGo();

  const double began_us = threadTime_us();
  Tick tick = servo_.step(handFrom(state), limitedTo(device_.capabilities(), settings_.rate_Hz, commands_.read()),
                          1.0 / settings_.rate_Hz);
  last_ = gate_.admit(inDevice({tick.served_force_P_N, tick.served_torque_P_Nmm}), state.jacobian_D_mm, true);
  tick.work_us = static_cast<float>(threadTime_us() - began_us);
  log_.push(tick);
  newest_.publish(tick);
  statistics_.add(static_cast<double>(tick.work_us), beat.late_us);
  statistics_.addMissed(beat.missed);
  return last_;
}

MotorCommand HapticLoop::letGo() noexcept {
  // Both go down together, the one that needs longest at its slew limit.
  const SafetyLimits limits = sanitised(commands_.read().safety);
  const Wrench<Device>& wrench = last_.wrench_D();
  const double seconds = std::max(glm::length(wrench.force_N.xyz) / limits.slew_N_per_s,
                                  glm::length(wrench.torque_Nmm.xyz) / limits.slew_Nmm_per_s);
  share_left_ = seconds > 0.0 ? std::max(0.0, share_left_ - 1.0 / (settings_.rate_Hz * seconds)) : 0.0;
  if (gate_.isShut()) share_left_ = 0.0;
  if (share_left_ > 0.0) return last_.faded(share_left_);
  phase_.store(Phase::over, std::memory_order_relaxed);
  return {};
}

}  // namespace haptics
