// A synthetic workstation with known truth: an arm with seeded errors under a mirror, a technician of realistic
// accuracy, a screen, eyes. For testing solvers, wizard and commands, and for practice. Frame W, mm, rad. Pure
// functions of the seed, the same on every machine. Any thread but the servo's. Error sizes: reference/calibration 3.1,
// assumptions until a unit has been measured.
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

/// A good unit · B typical Omni or Touch · C worn, not homed · D typical with errors that no correction can express · E
/// = D, stylus held one way during calibration · F = D, touched by eye · G = D with large model error.
enum class Scenario : char { a = 'A', b = 'B', c = 'C', d = 'D', e = 'E', f = 'F', g = 'G' };
std::optional<Scenario> scenarioNamed(std::string_view letter);

struct TechnicianModel {
  TouchPrecision precision;     ///< of the tip position
  double arm_noise_rad = 8e-5;  ///< encoder quantisation after averaging
  double gimbal_noise_rad = 2e-3;
  double tilt_noise_rad = 0.05;  ///< deviation from the requested tilt, one sigma an axis
  double roll_rad = 0.5;         ///< maximum rotation about the stylus axis
  double outlier_share = 0.0;    ///< of touches that are off by 5 to 20 mm
  bool one_tilt = false;         ///< scenario E: ignores the requested tilt
};

struct SyntheticRig {
  Scenario scenario = Scenario::d;
  std::uint32_t seed = 1;
  PerturbedArm arm;
  Pose<World, Device> X_WD;  ///< the truth
  Rig nominal;               ///< before any calibration: mirrored workstation, device at its nominal pose
  TechnicianModel technician;

  Point<World> tip_W(const RawJoints& raw_rad) const { return X_WD * arm.tip_D(raw_rad); }
};

SyntheticRig syntheticRig(Scenario scenario, std::uint32_t seed);

/// One touch of a target; none: out of reach.
std::optional<Touch> simulatedTouch(const SyntheticRig& rig, const Target& target, std::mt19937& rng);
/// All touches of a plan; targets out of reach are moved a little, except a single fixed pit.
TouchSet simulatedTouches(const SyntheticRig& rig, const TargetPlan& plan, std::mt19937& rng);
/// `n` touches without position noise, uniform in ±`half_mm` about the origin, random tilt up to 29° about each axis:
/// for verification.
std::vector<Touch> heldOutTouches(const SyntheticRig& rig, int n, const glm::dvec3& half_mm, std::mt19937& rng);

/// Overnight drift: joint offsets after another homing, a pushed base; one sigma an axis.
SyntheticRig drifted(const SyntheticRig& rig, double offset_deg, double shift_mm, std::mt19937& rng);

}  // namespace calibration
