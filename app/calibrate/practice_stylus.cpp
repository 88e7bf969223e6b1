#include "app/calibrate/practice_stylus.h"

#include <algorithm>
#include <cmath>

#include "calibration/arm/phantom_models.h"

namespace app {
namespace {

using calibration::Device;
using calibration::Handle;
using calibration::Point;
using calibration::Pose;
using calibration::World;

constexpr double kTiltTime_s = 0.08, kSteadyTime_s = 0.05;
constexpr double kSteadiedShare = 0.2;  ///< remaining tremor in a pit
constexpr double kDocks_mm = 2.0;

bool isValid(const PracticePose& pose) {
  const double length = glm::length(pose.along_W.xyz);
  return std::isfinite(glm::length(pose.tip_W.mm)) && std::isfinite(length) && length > 0.1;
}

Pose<World, Handle> heldSo(const glm::dvec3& tip_W, const glm::dvec3& along_W, const glm::dvec3& tip_H_mm) {
  return calibration::handleHolding({.id = 0, .position_W = {tip_W}, .stylus_W = {along_W}}, tip_H_mm);
}

}  // namespace

PracticeStylus::PracticeStylus(const calibration::SyntheticRig& rig, const PracticePose& start, double tremor_rms_mm)
    : rig_(rig),
      omni_(*haptics::findSimulatedPhantom("omni")),
      pose_(start),
      sensors_(omni_.geometry, omni_.sensing, rig.seed, rig.arm),
      tremor_(tremor_rms_mm, rig.seed + 1),
      along_W_(glm::normalize(start.along_W.xyz)) {
  capabilities_.model = "practice stylus";
  capabilities_.serial = rig.nominal.device ? rig.nominal.device->serial : "";
  capabilities_.has_inkwell = true;
  hand_.position_mm = start.tip_W.mm;
  const Pose<Device, Handle> X_DH = rig_.X_WD.inverse() * heldSo(start.tip_W.mm, along_W_, rig_.arm.truth.tip_H_mm);
  const auto arm_rad = calibration::armAnglesFor(omni_.geometry, {X_DH.translation_mm});
  if (!arm_rad)
    throw haptics::DeviceError("practice stylus: its arm does not reach the start position, move it nearer");
  joints_ = {*arm_rad, calibration::wristAnglesFor(*arm_rad, X_DH.rotation)};
  seen_.publish({start.tip_W, {along_W_}});
}

void PracticeStylus::setPose(const PracticePose& pose) {
  if (isValid(pose)) pose_.publish(pose);
}

/// The handle pose after this step, with tremor.
Pose<Device, Handle> PracticeStylus::advanced(double dt_s) noexcept {
  const PracticePose& pose = pose_.read();
  if (pose.in_inkwell) {
    const Pose<Device, Handle> rest_DH{glm::dquat(1.0, 0.0, 0.0, 0.0), calibration::kOmniInkwell_D.mm};
    const Pose<World, Handle> X_WH = rig_.X_WD * rest_DH;
    hand_.position_mm = (X_WH * Point<Handle>{rig_.arm.truth.tip_H_mm}).mm;
    hand_.velocity_mm_per_s = glm::dvec3(0.0);
    along_W_ = X_WH.rotation * glm::dvec3(0.0, 0.0, 1.0);
    return rest_DH;
  }
  hand_.advance(pose.tip_W.mm, glm::dvec3(0.0), glm::dvec3(0.0), dt_s);
  const glm::dvec3 turned = glm::mix(along_W_, glm::normalize(pose.along_W.xyz), -std::expm1(-dt_s / kTiltTime_s));
  if (glm::length(turned) > 1e-3) along_W_ = glm::normalize(turned);
  steady_ += -std::expm1(-dt_s / kSteadyTime_s) * ((pose.steadied ? 1.0 : 0.0) - steady_);
  const glm::dvec3 tremor_mm = glm::mix(1.0, kSteadiedShare, steady_) * tremor_.at(t_s_);
  return rig_.X_WD.inverse() * heldSo(hand_.position_mm + tremor_mm, along_W_, rig_.arm.truth.tip_H_mm);
}

haptics::HandleState PracticeStylus::exchange(const haptics::Wrench<Device>&, double dt_s) noexcept {
  t_s_ += dt_s;
  const Pose<Device, Handle> X_DH = advanced(dt_s);
  // Out of reach, it stays where it was.
  if (const auto arm_rad = calibration::armAnglesFor(omni_.geometry, {X_DH.translation_mm})) joints_.arm_rad = *arm_rad;
  const glm::dvec3 wrist_rad = calibration::wristAnglesFor(joints_.arm_rad, X_DH.rotation);
  for (int axis = 0; axis < 3; ++axis) {
    const calibration::AngleRange& range = omni_.geometry.wrist[static_cast<std::size_t>(axis)];
    joints_.wrist_rad[axis] = std::clamp(wrist_rad[axis], range.min_rad, range.max_rad);
  }
  const Pose<Device, Handle> is_DH = calibration::handlePose(omni_.geometry, joints_);
  const Pose<World, Handle> X_WH = rig_.X_WD * is_DH;
  seen_.publish({X_WH * Point<Handle>{rig_.arm.truth.tip_H_mm}, {X_WH.rotation * glm::dvec3(0.0, 0.0, 1.0)}});

  const haptics::PhantomSensors::Reading read = sensors_.read(joints_, hand_.velocity_mm_per_s, dt_s);
  haptics::HandleState state;
  state.X_DH = read.X_DH;
  state.velocity_D_mm_per_s = read.velocity_D_mm_per_s;
  state.jacobian_D_mm = read.jacobian_D_mm;
  state.joints_rad = read.joints_rad;
  state.has_joints = true;
  state.buttons = pose_.read().button ? 1U : 0U;
  state.docked = glm::distance(is_DH.translation_mm, calibration::kOmniInkwell_D.mm) < kDocks_mm;
  calibrated_ = calibrated_ || state.docked;
  state.calibrated = calibrated_;
  return state;
}

}  // namespace app
