#include "calibration/synthetic/synthetic_rig.h"

#include <array>
#include <cmath>

#include "calibration/arm/phantom_models.h"
#include "calibration/chance.h"
#include "calibration/geometry/turn.h"

namespace calibration {
namespace {

/// One sigma of each; what is fixed is so in every rig.
struct ErrorSizes {
  double link_mm, offset_deg, gain, axes_deg, reach_mm;
  double gimbal_deg, gimbal_gain, tip_mm;
  double cyclic_deg;                              ///< fixed
  double warp_mm = 0.0, gimbal_ripple_deg = 0.0;  ///< root mean square of the place; fixed
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

/// A stand is put down by eye.
constexpr double kStandTurn_deg = 3.0, kStandShift_mm = 12.0;  ///< at most, an axis
/// Touches that slip or are of another pit.
constexpr double kOutlierShare = 0.02, kLeastOutlier_mm = 5.0, kMostOutlier_mm = 20.0;
/// Held one way, a hand still trembles and turns with the arm.
constexpr double kOneTiltNoise_rad = 0.03;
constexpr double kHeldOutTilt_rad = 0.5;
/// How far a technician moves a target that is out of reach, one sigma for each try.
constexpr double kOtherHold_mm = 5.0;
constexpr int kTries = 60;

UntrueArm drawnArm(const ErrorSizes& sizes, std::mt19937& chance) {
  UntrueArm arm;
  arm.geometry = kOmniGeometry;
  ArmCorrection& truth = arm.truth;
  truth.thigh_more_mm = gaussian(chance, sizes.link_mm);
  truth.shin_more_mm = gaussian(chance, sizes.link_mm);
  for (std::size_t i = 0; i < 3; ++i) {
    truth.offset_rad[i] = gaussian(chance, radFromDegrees(sizes.offset_deg));
    truth.gain[i] = gaussian(chance, sizes.gain);
    arm.ripple[i] = {radFromDegrees(sizes.cyclic_deg), evenly(chance, 8.0, 25.0), evenly(chance, 0.0, 2.0 * kPi)};
  }
  for (std::size_t i = 3; i < 6; ++i) {
    truth.offset_rad[i] = gaussian(chance, radFromDegrees(sizes.gimbal_deg));
    truth.gain[i] = gaussian(chance, sizes.gimbal_gain);
    arm.ripple[i] = {radFromDegrees(sizes.gimbal_ripple_deg), 3.0, evenly(chance, 0.0, 2.0 * kPi)};
  }
  truth.tilt_rad = gaussian(chance, radFromDegrees(sizes.axes_deg));
  truth.reach_more_mm = gaussian(chance, sizes.reach_mm);
  truth.tip_H_mm += gaussianVector(chance, sizes.tip_mm);

  // Six waves about 250 mm long: a third of the size in each axis makes the whole of it.
  for (Warp& one : arm.warp)
    one = {gaussianVector(chance, sizes.warp_mm / 3.0), gaussianVector(chance, 1.0 / 40.0),
           evenly(chance, 0.0, 2.0 * kPi)};
  return arm;
}

Pose<World, Device> putDown(const Pose<World, Device>& nominal, std::mt19937& chance) {
  const glm::dvec3 turn_rad = evenVector(chance, glm::dvec3(radFromDegrees(kStandTurn_deg)));
  const glm::dvec3 shift_mm = evenVector(chance, glm::dvec3(kStandShift_mm));
  return {turnBy(turn_rad) * nominal.rotation, nominal.translation_mm + shift_mm};
}

/// What the sensors read while the handle is there; none beyond the stops of arm or gimbal.
std::optional<RawJoints> readAt(const SyntheticRig& rig, const Pose<World, Handle>& X_WH, std::mt19937& chance) {
  auto raw = rig.arm.rawAt(rig.X_WD.inverse() * X_WH);
  if (!raw) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    if (!rig.arm.geometry.wrist[i].contains((*raw)[i + 3])) return std::nullopt;
  for (std::size_t i = 0; i < raw->size(); ++i)
    (*raw)[i] += gaussian(chance, i < 3 ? rig.habits.arm_noise_rad : rig.habits.gimbal_noise_rad);
  return raw;
}

/// Turned about the handle's own axes, the tip where it is.
Pose<World, Handle> turnedAboutTip(const Pose<World, Handle>& X_WH, const glm::dvec3& tip_H_mm,
                                   const glm::dvec3& turn_rad) {
  const glm::dquat turn = X_WH.rotation * glm::angleAxis(turn_rad.y, glm::dvec3(0.0, 1.0, 0.0)) *
                          glm::angleAxis(turn_rad.x, glm::dvec3(1.0, 0.0, 0.0)) *
                          glm::angleAxis(turn_rad.z, glm::dvec3(0.0, 0.0, 1.0));
  return {turn, (X_WH * Point<Handle>{tip_H_mm}).mm - turn * tip_H_mm};
}

}  // namespace

std::optional<Scenario> scenarioNamed(std::string_view letter) {
  if (letter.size() != 1 || letter[0] < 'A' || letter[0] > 'G') return std::nullopt;
  return static_cast<Scenario>(letter[0]);
}

SyntheticRig syntheticRig(Scenario scenario, std::uint32_t seed) {
  // Neighbouring seeds of a Mersenne twister begin alike: the first draws are left.
  std::mt19937 chance(seed);
  chance.discard(1000);

  SyntheticRig rig;
  rig.scenario = scenario;
  rig.seed = seed;
  rig.arm = drawnArm(sizesOf(scenario), chance);
  rig.nominal = mirroredWorkstationRig();
  rig.nominal.device = RigDevice{.model = "omni",
                                 .serial = std::string("SIM-") + static_cast<char>(scenario) + std::to_string(seed),
                                 .mount = "right",
                                 .stylus_tip = "ball-3mm"};
  rig.X_WD = putDown(rig.nominal.X_WD, chance);
  rig.habits.outlier_share = kOutlierShare;
  rig.habits.precision = scenario == Scenario::f ? kCrossPrecision : kPitPrecision;
  if (scenario == Scenario::e) {
    rig.habits.one_tilt = true;
    rig.habits.tilt_noise_rad = rig.habits.roll_rad = kOneTiltNoise_rad;
  }
  return rig;
}

std::optional<Touch> touched(const SyntheticRig& rig, const Target& target, std::mt19937& chance) {
  const TouchHabits& habits = rig.habits;
  // Where the tip truly is: never quite at the target, now and then elsewhere.
  Target hold = target;
  hold.place_W.mm +=
      glm::dvec3(gaussian(chance, habits.precision.in_plane_mm), gaussian(chance, habits.precision.in_plane_mm),
                 gaussian(chance, habits.precision.along_sight_mm));
  if (evenly(chance, 0.0, 1.0) < habits.outlier_share)
    hold.place_W.mm += evenly(chance, kLeastOutlier_mm, kMostOutlier_mm) * glm::normalize(gaussianVector(chance, 1.0));

  if (habits.one_tilt) hold.stylus_W = kRestingStylus_W;
  const glm::dvec3 turn_rad(gaussian(chance, habits.tilt_noise_rad), gaussian(chance, habits.tilt_noise_rad),
                            evenly(chance, -habits.roll_rad, habits.roll_rad));
  const glm::dvec3& tip_H_mm = rig.arm.truth.tip_H_mm;
  const auto raw = readAt(rig, turnedAboutTip(handleHolding(hold, tip_H_mm), tip_H_mm, turn_rad), chance);
  if (!raw) return std::nullopt;
  return Touch{.id = target.id, .joints_rad = *raw, .target_W = target.place_W};
}

TouchSet touchedAll(const SyntheticRig& rig, const TargetPlan& plan, std::mt19937& chance) {
  const RigDevice& device = *rig.nominal.device;
  TouchSet set{.device_model = device.model,
               .serial = device.serial,
               .mount = device.mount,
               .method = plan.method,
               .precision = plan.precision,
               .touches = {}};
  for (Target target : plan.targets) {
    auto touch = touched(rig, target, chance);
    for (int n = 0; !touch && n < kTries; ++n) {
      if (!plan.one_pit) target.place_W.mm += gaussianVector(chance, kOtherHold_mm) - 0.1 * target.place_W.mm;
      touch = touched(rig, target, chance);
    }
    if (touch) set.touches.push_back(*touch);
  }
  return set;
}

std::vector<Touch> heldOut(const SyntheticRig& rig, int n, const glm::dvec3& half_mm, std::mt19937& chance) {
  std::vector<Touch> touches;
  const glm::dvec3& tip_H_mm = rig.arm.truth.tip_H_mm;
  while (static_cast<int>(touches.size()) < n) {
    const Target target{static_cast<int>(touches.size()) + 1, {evenVector(chance, half_mm)}, kRestingStylus_W};
    const glm::dvec3 turn_rad = evenVector(chance, glm::dvec3(kHeldOutTilt_rad));
    const auto raw = readAt(rig, turnedAboutTip(handleHolding(target, tip_H_mm), tip_H_mm, turn_rad), chance);
    if (raw) touches.push_back({.id = target.id, .joints_rad = *raw, .target_W = target.place_W});
  }
  return touches;
}

SyntheticRig drifted(const SyntheticRig& rig, double offset_deg, double shift_mm, std::mt19937& chance) {
  SyntheticRig moved = rig;
  for (std::size_t i = 0; i < 3; ++i) moved.arm.truth.offset_rad[i] += gaussian(chance, radFromDegrees(offset_deg));
  moved.X_WD.translation_mm += gaussianVector(chance, shift_mm);
  return moved;
}

}  // namespace calibration
