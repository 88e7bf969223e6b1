#include "haptics/servo/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/geometry/units.h"
#include "haptics/contact/law_limits.h"

namespace haptics {
namespace {

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
  limited.law.damping_Ns_per_mm = at_most(command.law.damping_Ns_per_mm, device.max_damping_Ns_per_mm);
  safety.max_damping_Ns_per_mm = at_most(safety.max_damping_Ns_per_mm, device.max_damping_Ns_per_mm);
  safety.max_stiffness_N_per_mm = at_most(safety.max_stiffness_N_per_mm, device.max_stiffness_N_per_mm);
  safety.max_stiffness_N_per_mm =
      at_most(safety.max_stiffness_N_per_mm,
              0.9 * passiveStiffness_N_per_mm(device.damping_Ns_per_mm, limited.law.damping_Ns_per_mm, 1.0 / rate_Hz));
  for (int joint = 0; joint < 3; ++joint)
    if (const double most = sanitisedJointPeak_Nmm(device.peak_joint_torque_Nmm[joint]); most > 0.0) {
      double& peak = safety.peak_joint_torque_Nmm[joint];
      peak = peak > 0.0 ? std::min(peak, most) : most;
    }
  if (!device.has_motors) return limited;

  // Nine tenths, for the maker's own limit switches the motors off.
  safety = strict(safety);
  safety.peak_force_N = at_most(safety.peak_force_N, 0.9 * device.peak_force_N);
  safety.continuous_force_N = at_most(safety.continuous_force_N, device.continuous_force_N);
  return limited;
}

HapticLoop::HapticLoop(Servo& servo, ServedDevice served, Latest<Command>& commands, TickLog& log, Latest<Tick>& newest,
                       const LoopSettings& settings)
    : DeviceLoop(served, settings.rate_Hz, settings.priority),
      servo_(servo),
      commands_(commands),
      log_(log),
      newest_(newest),
      settings_(settings),
      X_DP_(settings.X_PD.inverse()),
      handle_(settings.arm) {
  if (!rigid(settings.X_PD)) throw DeviceError("pose of the device, not finite and rigid, calibrate the rig again");
  if (!rigid(settings.X_HT))
    throw DeviceError("pose of the tool in the handle, not finite and rigid, measure it again");
}

HandSample HapticLoop::handFrom(const HandleState& measured, const TickTiming& timing, const Tool& tool) noexcept {
  const HandleState state = handle_.corrected(measured);
  HandSample hand;
  const auto X_PH = settings_.X_PD * state.X_DH;
  // Another instrument works where the one before it did: no hand is jumped, and no velocity made of it.
  const double reach_mm = settings_.held_by_end ? tool.reach_mm() : 0.0;
  if (reach_mm != std::exchange(reach_mm_, reach_mm)) has_arm_ = false;
  auto X_HT = settings_.X_HT;
  X_HT.translation_mm += X_HT.rotation * glm::dvec3(0.0, 0.0, reach_mm);
  hand.X_PT = X_PH * X_HT;
  hand.jacobian_P_mm = glm::mat3_cast(settings_.X_PD.rotation) * state.jacobian_D_mm;
  hand.motor_heat = state.motor_heat;
  hand.gap_s = timing.gap_s;
  hand.drill_pedal = drills(state);
  hand.fresh = state.fresh;
  hand.docked = state.docked;
  hand.held = state.held;
  hand.calibrated = state.calibrated;
  hand.stop_requested = isForceDisabled();
  hand.device_healthy = state.healthy;

  // The device measures the handle's velocity; rotation moves the tool too: differenced and smoothed at 100 Hz.
  const glm::dvec3 arm_P_mm = X_PH.rotation * X_HT.translation_mm;
  const double blend = 1.0 - std::exp(-2.0 * calibration::kPi * 100.0 / settings_.rate_Hz);
  const glm::dvec3 difference = has_arm_ ? (arm_P_mm - last_arm_P_mm_) * settings_.rate_Hz : glm::dvec3(0.0);
  arm_velocity_P_mm_per_s_ += blend * (difference - arm_velocity_P_mm_per_s_);
  if (!std::isfinite(glm::length(arm_velocity_P_mm_per_s_))) arm_velocity_P_mm_per_s_ = glm::dvec3(0.0);
  last_arm_P_mm_ = arm_P_mm;
  has_arm_ = std::isfinite(glm::length(arm_P_mm));
  hand.arm_P_mm.xyz = -arm_P_mm;
  hand.handle_velocity_P_mm_per_s = settings_.X_PD * state.velocity_D_mm_per_s;
  hand.velocity_P_mm_per_s = hand.handle_velocity_P_mm_per_s;
  hand.velocity_P_mm_per_s.xyz += arm_velocity_P_mm_per_s_;
  return hand;
}

bool HapticLoop::drills(const HandleState& state) noexcept {
  const HandActions pressed = settings_.buttons.actionsOf(state.buttons);
  const HandActions begun = press_count_.look(pressed);
  held_.store(pressed.bits, std::memory_order_relaxed);
  for (std::size_t i = 0; i < kHandActions; ++i)
    if (begun.has(static_cast<HandAction>(i))) presses_[i].fetch_add(1, std::memory_order_relaxed);
  return state.pedal || pressed.has(HandAction::drill) ||
         (settings_.pedal != nullptr && settings_.pedal->held().has(HandAction::drill));
}

DeviceLoop::Answer HapticLoop::answer(const HandleState& state, const TickTiming& timing) noexcept {
  const Command& command = commands_.read();
  tick_ = servo_.step(handFrom(state, timing, command.tool), limitedTo(device(), rate_Hz(), command), 1.0 / rate_Hz());
  return {{X_DP_ * tick_.commanded_force_P_N, X_DP_ * tick_.commanded_torque_P_Nmm}, mayRunMotors(tick_.state)};
}

void HapticLoop::answered(double work_us) noexcept {
  tick_.work_us = static_cast<float>(work_us);
  log_.push(tick_);
  if (settings_.second_log != nullptr) settings_.second_log->push(tick_);
  newest_.publish(tick_);

  ledger_.add(tick_.index, tick_.faults);
  if (tick_.faults != last_faults_) trips_.publish(ledger_);
  last_faults_ = tick_.faults;
}

}  // namespace haptics
