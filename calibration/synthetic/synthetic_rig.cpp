#include "calibration/synthetic/synthetic_rig.h"

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/rotation.h"
#include "calibration/random.h"

namespace calibration {
namespace {

/// One sigma of each; fixed ones are the same in every rig.
struct ErrorSizes {
  double link_mm, offset_deg, gain, axes_deg, reach_mm;
  double gimbal_deg, gimbal_gain, tip_mm;
  double cyclic_deg;                              ///< fixed
  double warp_mm = 0.0, gimbal_ripple_deg = 0.0;  ///< RMS in position; fixed
};
constexpr ErrorSizes kGood{0.15, 0.15, 0.001, 0.05, 0.1, 0.3, 0.003, 0.1, 0.005};
constexpr ErrorSizes kTypical{0.4, 0.5, 0.004, 0.15, 0.3, 1.0, 0.01, 0.4, 0.02};
constexpr ErrorSizes kWorn{0.8, 1.5, 0.008, 0.3, 0.5, 2.0, 0.02, 0.8, 0.03};
constexpr ErrorSizes kMismatched{0.4, 0.5, 0.004, 0.15, 0.3, 1.0, 0.01, 0.4, 0.05, 0.15, 0.3};
constexpr ErrorSizes kFarMismatched{0.4, 0.5, 0.004, 0.15, 0.3, 1.0, 0.01, 0.4, 0.1, 0.5, 1.0};

const ErrorSizes& sizesOf(Scenario scenario) {
  switch (scenario) {
    case Scenario::a:
      return kGood;
    case Scenario::b:
      return kTypical;
    case Scenario::c:
      return kWorn;
    case Scenario::g:
      return kFarMismatched;
    case Scenario::d:
    case Scenario::e:
    case Scenario::f:
      break;
  }
  return kMismatched;
}

/// A stand placed by eye.
constexpr double kStandRotation_deg = 3.0, kStandTranslation_mm = 12.0;  ///< maximum, an axis
/// Slipped touches, or touches of another pit.
constexpr double kOutlierShare = 0.02, kMinOutlier_mm = 5.0, kMaxOutlier_mm = 20.0;
/// Residual tilt of a hand that holds one way.
constexpr double kOneTiltNoise_rad = 0.03;
constexpr double kHeldOutTilt_rad = 0.5;
/// Shift of a target that is out of reach, one sigma per try.
constexpr double kOtherHold_mm = 5.0;
constexpr int kTries = 60;

PerturbedArm drawnArm(const ErrorSizes& sizes, std::mt19937& rng) {
  PerturbedArm arm;
  arm.geometry = kOmniGeometry;
  ArmCorrection& truth = arm.truth;
  truth.thigh_delta_mm = gaussian(rng, sizes.link_mm);
  truth.shin_delta_mm = gaussian(rng, sizes.link_mm);
  for (std::size_t i = 0; i < 3; ++i) {
    truth.offset_rad[i] = gaussian(rng, radFromDegrees(sizes.offset_deg));
    truth.gain[i] = gaussian(rng, sizes.gain);
    arm.ripple[i] = {radFromDegrees(sizes.cyclic_deg), uniform(rng, 8.0, 25.0), uniform(rng, 0.0, 2.0 * kPi)};
  }
  for (std::size_t i = 3; i < 6; ++i) {
    truth.offset_rad[i] = gaussian(rng, radFromDegrees(sizes.gimbal_deg));
    truth.gain[i] = gaussian(rng, sizes.gimbal_gain);
    arm.ripple[i] = {radFromDegrees(sizes.gimbal_ripple_deg), 3.0, uniform(rng, 0.0, 2.0 * kPi)};
  }
  truth.tilt_rad = gaussian(rng, radFromDegrees(sizes.axes_deg));
  truth.reach_delta_mm = gaussian(rng, sizes.reach_mm);
  truth.tip_H_mm += gaussianVector(rng, sizes.tip_mm);

  // Six waves about 250 mm long; a third of the size per axis gives the whole size.
  for (Warp& one : arm.warp)
    one = {gaussianVector(rng, sizes.warp_mm / 3.0), gaussianVector(rng, 1.0 / 40.0), uniform(rng, 0.0, 2.0 * kPi)};
  return arm;
}

Pose<World, Device> putDown(const Pose<World, Device>& nominal, std::mt19937& rng) {
  const glm::dvec3 rotation_rad = uniformVector(rng, glm::dvec3(radFromDegrees(kStandRotation_deg)));
  const glm::dvec3 translation_mm = uniformVector(rng, glm::dvec3(kStandTranslation_mm));
  return {rotationFromVector(rotation_rad) * nominal.rotation, nominal.translation_mm + translation_mm};
}

/// Sensor readings with noise; none: beyond the stops of arm or gimbal.
std::optional<RawJoints> readAt(const SyntheticRig& rig, const Pose<World, Handle>& X_WH, std::mt19937& rng) {
  auto raw = rig.arm.rawAt(rig.X_WD.inverse() * X_WH);
  if (!raw) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    if (!rig.arm.geometry.wrist[i].contains((*raw)[i + 3])) return std::nullopt;
  for (std::size_t i = 0; i < raw->size(); ++i)
    (*raw)[i] += gaussian(rng, i < 3 ? rig.technician.arm_noise_rad : rig.technician.gimbal_noise_rad);
  return raw;
}

/// Rotated about the handle's own axes with the tip fixed.
Pose<World, Handle> turnedAboutTip(const Pose<World, Handle>& X_WH, const glm::dvec3& tip_H_mm,
                                   const glm::dvec3& rotation_rad) {
  const glm::dquat rotation = X_WH.rotation * glm::angleAxis(rotation_rad.y, glm::dvec3(0.0, 1.0, 0.0)) *
                              glm::angleAxis(rotation_rad.x, glm::dvec3(1.0, 0.0, 0.0)) *
                              glm::angleAxis(rotation_rad.z, glm::dvec3(0.0, 0.0, 1.0));
  return {rotation, (X_WH * Point<Handle>{tip_H_mm}).mm - rotation * tip_H_mm};
}

}  // namespace

std::optional<Scenario> scenarioNamed(std::string_view letter) {
  if (letter.size() != 1 || letter[0] < 'A' || letter[0] > 'G') return std::nullopt;
  return static_cast<Scenario>(letter[0]);
}

SyntheticRig syntheticRig(Scenario scenario, std::uint32_t seed) {
  // Neighbouring seeds of a Mersenne twister start alike: skip the first draws.
  std::mt19937 rng(seed);
  rng.discard(1000);

  SyntheticRig rig;
  rig.scenario = scenario;
  rig.seed = seed;
  rig.arm = drawnArm(sizesOf(scenario), rng);
  rig.nominal = mirroredWorkstationRig();
  rig.nominal.device = RigDevice{.model = "omni",
                                 .serial = std::string("SIM-") + static_cast<char>(scenario) + std::to_string(seed),
                                 .mount = "right",
                                 .stylus_tip = "ball-3mm"};
  rig.X_WD = putDown(rig.nominal.X_WD, rng);
  rig.technician.outlier_share = kOutlierShare;
  rig.technician.precision = scenario == Scenario::f ? kCrossPrecision : kPitPrecision;
  if (scenario == Scenario::e) {
    rig.technician.one_tilt = true;
    rig.technician.tilt_noise_rad = rig.technician.roll_rad = kOneTiltNoise_rad;
  }
  return rig;
}

std::optional<Touch> simulatedTouch(const SyntheticRig& rig, const Target& target, std::mt19937& rng) {
  const TechnicianModel& technician = rig.technician;
  // True tip position: near the target, or an outlier.
  Target hold = target;
  hold.position_W.mm +=
      glm::dvec3(gaussian(rng, technician.precision.in_plane_mm), gaussian(rng, technician.precision.in_plane_mm),
                 gaussian(rng, technician.precision.along_sight_mm));
  if (uniform(rng, 0.0, 1.0) < technician.outlier_share)
    hold.position_W.mm += uniform(rng, kMinOutlier_mm, kMaxOutlier_mm) * glm::normalize(gaussianVector(rng, 1.0));

  if (technician.one_tilt) hold.stylus_W = kRestingStylus_W;
  const glm::dvec3 rotation_rad(gaussian(rng, technician.tilt_noise_rad), gaussian(rng, technician.tilt_noise_rad),
                                uniform(rng, -technician.roll_rad, technician.roll_rad));
  const glm::dvec3& tip_H_mm = rig.arm.truth.tip_H_mm;
  const auto raw = readAt(rig, turnedAboutTip(handleHolding(hold, tip_H_mm), tip_H_mm, rotation_rad), rng);
  if (!raw) return std::nullopt;
  return Touch{.id = target.id, .joints_rad = *raw, .target_W = target.position_W};
}

TouchSet simulatedTouches(const SyntheticRig& rig, const TargetPlan& plan, std::mt19937& rng) {
  const RigDevice& device = *rig.nominal.device;
  TouchSet set{.device_model = device.model,
               .serial = device.serial,
               .mount = device.mount,
               .method = plan.method,
               .precision = plan.precision,
               .touches = {}};
  for (Target target : plan.targets) {
    auto touch = simulatedTouch(rig, target, rng);
    for (int n = 0; !touch && n < kTries; ++n) {
      if (!plan.one_pit) target.position_W.mm += gaussianVector(rng, kOtherHold_mm) - 0.1 * target.position_W.mm;
      touch = simulatedTouch(rig, target, rng);
    }
    if (touch) set.touches.push_back(*touch);
  }
  return set;
}

std::vector<Touch> heldOutTouches(const SyntheticRig& rig, int n, const glm::dvec3& half_mm, std::mt19937& rng) {
  std::vector<Touch> touches;
  const glm::dvec3& tip_H_mm = rig.arm.truth.tip_H_mm;
  while (static_cast<int>(touches.size()) < n) {
    const Target target{static_cast<int>(touches.size()) + 1, {uniformVector(rng, half_mm)}, kRestingStylus_W};
    const glm::dvec3 rotation_rad = uniformVector(rng, glm::dvec3(kHeldOutTilt_rad));
    const auto raw = readAt(rig, turnedAboutTip(handleHolding(target, tip_H_mm), tip_H_mm, rotation_rad), rng);
    if (raw) touches.push_back({.id = target.id, .joints_rad = *raw, .target_W = target.position_W});
  }
  return touches;
}

SyntheticRig drifted(const SyntheticRig& rig, double offset_deg, double translation_mm, std::mt19937& rng) {
  SyntheticRig moved = rig;
  for (std::size_t i = 0; i < 3; ++i) moved.arm.truth.offset_rad[i] += gaussian(rng, radFromDegrees(offset_deg));
  moved.X_WD.translation_mm += gaussianVector(rng, translation_mm);
  return moved;
}

}  // namespace calibration
