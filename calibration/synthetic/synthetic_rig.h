// A workstation whose truth is known: an arm with seeded errors somewhere under a mirror, a technician whose touches
// are as exact as people's are, a screen, eyes. What solvers, wizard and commands are proved with, and what a
// technician practises on. Frame W, mm, rad. Pure functions of the seed: the same on every machine. Any thread but the
// servo's. Error sizes: reference/calibration 3.1, assumptions until a unit has been measured.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string_view>

#include "calibration/fit/target_plan.h"
#include "calibration/fit/touches.h"
#include "calibration/rig.h"
#include "calibration/synthetic/perturbed_arm.h"

namespace calibration {

/// A good unit · B typical Omni or Touch · C bad, worn, not homed · D typical with what no correction can express ·
/// E = D, stylus held one way while it is calibrated · F = D, simulatedTouch by eye · G = D with large mismatch.
enum class Scenario : char { a = 'A', b = 'B', c = 'C', d = 'D', e = 'E', f = 'F', g = 'G' };
std::optional<Scenario> scenarioNamed(std::string_view letter);

struct TechnicianModel {
  TouchPrecision precision;     ///< of the place
  double arm_noise_rad = 8e-5;  ///< left of the encoders' steps after averaging
  double gimbal_noise_rad = 2e-3;
  double tilt_noise_rad = 0.05;  ///< how closely the cue's tilt is held, one sigma an axis
  double roll_rad = 0.5;         ///< the stylus is turned about itself as it comes, at most so far
  double outlier_share = 0.0;    ///< of touches that are off by 5 to 20 mm
  bool one_tilt = false;         ///< scenario E: whatever the cue asks
};

struct SyntheticRig {
  Scenario scenario = Scenario::d;
  std::uint32_t seed = 1;
  PerturbedArm arm;
  Pose<World, Device> X_WD;  ///< the truth
  Rig nominal;  ///< what is believed before any calibration: mirrored workstation, device where it should be
  TechnicianModel technician;

  Point<World> tip_W(const RawJoints& raw_rad) const { return X_WD * arm.tip_D(raw_rad); }
};

SyntheticRig syntheticRig(Scenario scenario, std::uint32_t seed);

/// One touch of a target; none where the arm does not reach it so.
std::optional<Touch> simulatedTouch(const SyntheticRig& rig, const Target& target, std::mt19937& rng);
/// A whole procedure; targets out of reach are moved a little, as a technician would find another hold, a pit that
/// stays where it is excepted.
TouchSet simulatedTouches(const SyntheticRig& rig, const TargetPlan& plan, std::mt19937& rng);
/// `n` touches without noise of place, anywhere in ±`half_mm` about the origin, stylus tilted at random up to 29°
/// about each axis: what a calibration is charted by.
std::vector<Touch> heldOutTouches(const SyntheticRig& rig, int n, const glm::dvec3& half_mm, std::mt19937& rng);

/// What a night does: joint offsets after another homing, a base that was pushed; one sigma each, an axis.
SyntheticRig drifted(const SyntheticRig& rig, double offset_deg, double shift_mm, std::mt19937& rng);

}  // namespace calibration
