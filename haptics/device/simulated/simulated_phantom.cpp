#include "haptics/device/simulated/simulated_phantom.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "haptics/device/simulated/dry_friction.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::Vector;

constexpr double kDocks_mm = 2.0, kUndocks_mm = 4.0;

void refuseUnlessPossible(const PhantomMechanics& m, const Grip& grip) {
  const std::string name = "simulated " + std::string(m.name);
  for (double number :
       {m.sensing.counts_per_turn, m.sensing.levels_per_turn, m.sensing.velocity_cutoff_Hz, m.viscous_Ns_per_mm,
        m.dry_N, grip.mass_kg, grip.stiffness_N_per_mm, grip.damping_Ns_per_mm, grip.tremor_rms_mm})
    if (!(std::isfinite(number) && number >= 0.0))
      throw DeviceError(name + ", one of its numbers is negative or not finite, give usable ones");
  for (double number : {m.geometry.thigh_mm, m.geometry.shin_mm, m.mass_kg, m.peak_force_N, m.peak_joint_Nmm,
                        m.continuous_force_N, m.heat_time_s})
    if (!(std::isfinite(number) && number > 0.0))
      throw DeviceError(name + ", one of its numbers is not positive, give it length, mass, force and time");
  if (m.latency_ticks < 0 || m.latency_ticks > SimulatedPhantom::kMaxLatency_ticks)
    throw DeviceError(name + ", its latency is " + std::to_string(m.latency_ticks) + " ticks, give 0 to " +
                      std::to_string(SimulatedPhantom::kMaxLatency_ticks));
}

DeviceCapabilities capabilitiesOf(const PhantomMechanics& m, const Grip& grip, const PhantomUnit& unit) {
  DeviceCapabilities can;
  can.model = "simulated " + std::string(m.name);
  can.serial = unit.serial;
  can.arm_model = m.key;
  can.has_motors = true;
  can.has_inkwell = m.has_inkwell;
  can.pauses_with_ticks = true;
  can.has_deadman = m.has_deadman;
  can.peak_force_N = m.peak_force_N;
  can.continuous_force_N = m.continuous_force_N;
  can.peak_joint_torque_Nmm = glm::dvec3(m.peak_joint_Nmm);
  can.max_stiffness_N_per_mm = m.max_stiffness_N_per_mm;
  can.max_damping_Ns_per_mm = m.max_damping_Ns_per_mm;
  // With delay K < b / (T/2 + t) instead of 2 b / T (Gil, Hulin; reference/physics 2.5): as if it had less of it.
  can.damping_Ns_per_mm = (m.viscous_Ns_per_mm + grip.damping_Ns_per_mm) / (1.0 + 2.0 * m.latency_ticks);
  can.workspace = m.workspace;
  return can;
}

}  // namespace

SimulatedPhantom::SimulatedPhantom(const PhantomMechanics& mechanics, HandScript script, const Grip& grip,
                                   std::uint32_t seed, const PhantomUnit& unit)
    : mechanics_((refuseUnlessPossible(mechanics, grip), mechanics)),
      hand_(std::move(script), grip, seed),
      sensors_(mechanics.geometry, mechanics.sensing, seed + 1, unit.untrue),
      heat_(glm::dvec3(mechanics.peak_joint_Nmm * mechanics.continuous_force_N / mechanics.peak_force_N),
            mechanics.heat_time_s) {
  capabilities_ = capabilitiesOf(mechanics, grip, unit);
  const HandTarget start = hand_.at(0.0);
  const auto arm_rad = armAnglesFor(mechanics_.geometry, {start.position_mm});
  if (!arm_rad)
    throw DeviceError(capabilities_.model + ", its arm does not reach where the hand starts, move it nearer");
  joints_.arm_rad = *arm_rad;
  joints_.wrist_rad = calibration::wristAnglesFor(*arm_rad, start.rotation);
  rotate(start);
  rest_rad_ = armAnglesFor(mechanics_.geometry, mechanics_.rest_D).value_or(*arm_rad);
  handle_.position_mm = start.position_mm;
  handle_.friction_Ns_per_mm = mechanics_.viscous_Ns_per_mm;
  calibrated_ = !mechanics_.has_inkwell;
  dock(start);
}

HandleState SimulatedPhantom::exchange(const Wrench<Device>& wrench_D, double dt_s) noexcept {
  const HandTarget from = hand_.at(t_s_);
  t_s_ += dt_s;
  const HandTarget to = hand_.at(t_s_);
  pushed_N_ = motorForce_N(wrench_D.force_N.xyz, dt_s);
  move(from, to, dt_s);
  rotate(to);
  dock(to);

  const PhantomSensors::Reading read = sensors_.read(joints_, handle_.velocity_mm_per_s, dt_s);
  HandleState state;
  state.X_DH = read.X_DH;
  state.velocity_D_mm_per_s = read.velocity_D_mm_per_s;
  state.jacobian_D_mm = read.jacobian_D_mm;
  state.joints_rad = read.joints_rad;
  state.has_joints = true;
  state.buttons = to.buttons;
  state.pedal = to.pedal;
  state.docked = docked_;
  state.held = to.grips || !mechanics_.has_deadman;
  state.calibrated = calibrated_;
  state.motor_heat = heat_.warmest();
  return state;
}

glm::dvec3 SimulatedPhantom::motorForce_N(const glm::dvec3& requested_N, double dt_s) noexcept {
  // The request of some ticks ago; 0 if it was not finite.
  delayed_N_[tick_ % delayed_N_.size()] = std::isfinite(glm::length(requested_N)) ? requested_N : glm::dvec3(0.0);
  const std::size_t arrived = tick_ + delayed_N_.size() - static_cast<std::size_t>(mechanics_.latency_ticks);
  glm::dvec3 force_N = delayed_N_[arrived % delayed_N_.size()];
  ++tick_;

  // Above the heat limit, only the continuous force.
  const double share = heat_.warmest() < 1.0 ? 1.0 : mechanics_.continuous_force_N / mechanics_.peak_force_N;
  const double strong_N = glm::length(force_N);
  if (strong_N > share * mechanics_.peak_force_N) force_N *= share * mechanics_.peak_force_N / strong_N;
  const glm::dvec3 torque_Nmm = glm::abs(armTorque_Nmm(mechanics_.geometry, joints_.arm_rad, {force_N}));
  const double most_Nmm = std::max({torque_Nmm.x, torque_Nmm.y, torque_Nmm.z});
  const double fits = std::min(1.0, share * mechanics_.peak_joint_Nmm / std::max(most_Nmm, 1e-9));
  heat_.add(fits * torque_Nmm, dt_s);
  return fits * force_N;
}

void SimulatedPhantom::move(const HandTarget& from, const HandTarget& to, double dt_s) noexcept {
  if (!(dt_s > 0.0)) return;
  const Grip let_go{0.0, 0.0, 0.0, 0.0}, &grip = to.grips ? hand_.grip() : let_go;
  handle_.mass_kg = mechanics_.mass_kg + grip.mass_kg;
  handle_.stiffness_N_per_mm = grip.stiffness_N_per_mm;
  handle_.damping_Ns_per_mm = grip.damping_Ns_per_mm;
  const glm::dvec3 before_mm = handle_.position_mm;
  const glm::dvec3 goes_mm_per_s =
      to.grips && from.grips ? (to.position_mm - from.position_mm) / dt_s : glm::dvec3(0.0);
  advanceWithDryFriction(handle_, mechanics_.dry_N, from.position_mm, goes_mm_per_s, pushed_N_, dt_s);

  // At its stops the arm stays.
  if (const auto arm_rad = armAnglesFor(mechanics_.geometry, {handle_.position_mm})) {
    joints_.arm_rad = *arm_rad;
  } else {
    handle_.position_mm = before_mm;
    handle_.velocity_mm_per_s = glm::dvec3(0.0);
  }
}

void SimulatedPhantom::rotate(const HandTarget& to) noexcept {
  if (!to.grips) return;
  const glm::dvec3 wanted_rad = calibration::wristAnglesFor(joints_.arm_rad, to.rotation);
  for (int axis = 0; axis < 3; ++axis) {
    const calibration::AngleRange& range = mechanics_.geometry.wrist[static_cast<std::size_t>(axis)];
    joints_.wrist_rad[axis] = std::clamp(wanted_rad[axis], range.min_rad, range.max_rad);
  }
}

void SimulatedPhantom::dock(const HandTarget& to) noexcept {
  if (!mechanics_.has_inkwell) return;
  const double away_mm = glm::distance(handle_.position_mm, mechanics_.rest_D.mm);
  docked_ = away_mm < (docked_ ? kUndocks_mm : kDocks_mm);
  calibrated_ = calibrated_ || docked_;
  // A stylus that is let go in the inkwell stays there.
  if (!docked_ || to.grips) return;
  handle_.position_mm = mechanics_.rest_D.mm;
  handle_.velocity_mm_per_s = glm::dvec3(0.0);
  joints_.arm_rad = rest_rad_;
}

}  // namespace haptics
