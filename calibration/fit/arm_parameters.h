// The 28 parameters of a measured arm: 6 of the base's pose, 22 of the arm's correction, with their priors; and the
// Jacobian of the tip. The pose parameters are a rotation about, and a translation of, the centre of the targets from a
// near start, so that they are nearly uncorrelated. Frames W and D; mm, rad. Pure; any thread; about 0.5 us for a tip
// and its Jacobian. Prior sigmas: reference/calibration 2.1, 3.1, 1.6 to 2.5 times the sizes assumed for typical units.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibration/arm/arm_correction.h"
#include "calibration/geometry/units.h"

namespace calibration {

enum class ArmModel { rigid, joint_gains, full };

inline constexpr double kDegree = radFromDegrees(1.0);

/// One sigma of the prior of each parameter; 0: no prior.
inline constexpr std::array<double, 28> kArmPriorSigma = {
    // clang-format off
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0,                 // rotation about x, y, z (rad) and translation (mm) of the base
    1.0, 1.0, 1.0,                                // tip in H, mm
    kDegree, kDegree, kDegree,                    // offsets of turret, thigh and shin, rad
    0.01, 0.01, 0.01, 0.01, 0.01, 0.01,           // their gains; their quadratic terms, 1/rad
    0.7, 0.7,                                     // lengths of thigh and shin, mm
    2.0 * kDegree, 2.0 * kDegree, 2.0 * kDegree,  // offsets of the gimbal, rad
    0.03, 0.03, 0.03,                             // its gains
    0.3 * kDegree, 0.5};                          // shoulder tilt, rad; reach, mm
// clang-format on
using ArmParameters = std::array<double, kArmPriorSigma.size()>;

/// Parameters fitted by a model: rigid 6, joint gains and offsets with the tip 15, full 28.
std::vector<std::size_t> parametersOf(ArmModel model);

/// The arm for which all parameters are zero.
struct ArmStart {
  PhantomGeometry geometry;
  Pose<World, Device> X_WD;
  Point<World> middle_W;  ///< centre of the pose parameters' rotation
  ArmCorrection correction{};
};

MeasuredArm armOf(const ArmStart& start, const ArmParameters& parameters);

struct TipJacobian {
  glm::dvec3 tip_W_mm{0.0};
  std::array<glm::dvec3, kArmPriorSigma.size()> by_parameter{};  ///< d tip / d parameter
};
TipJacobian tipJacobian(const ArmStart& start, const ArmParameters& parameters, const RawJoints& raw_rad);

}  // namespace calibration
