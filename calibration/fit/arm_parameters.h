// The 28 parameters of a measured arm: six of where it stands, 22 of how it differs from its model, with what is
// believed of each before any touch; and how the tip moves with each of them. Pose parameters are a turn about, and a
// shift of, the middle of the targets from a start that is already near: so they hardly pull at each other. Frames W
// and D; mm, rad. Pure; any thread; a tip with its slopes about 0.5 us. Prior sigmas:
// reference/calibration 2.1, 3.1, 1.6 to 2.5 times what is assumed of typical units.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "calibration/arm/arm_correction.h"
#include "calibration/geometry/units.h"

namespace calibration {

enum class ArmModel { rigid, joint_gains, full };

struct ArmParameter {
  std::string_view name;
  double prior_sigma = 0.0;  ///< 0: nothing is believed
};

inline constexpr std::array<ArmParameter, 28> kArmParameters = {{
    {"turn_x_rad", 0.0},
    {"turn_y_rad", 0.0},
    {"turn_z_rad", 0.0},
    {"shift_x_mm", 0.0},
    {"shift_y_mm", 0.0},
    {"shift_z_mm", 0.0},
    {"tip_x_mm", 1.0},
    {"tip_y_mm", 1.0},
    {"tip_z_mm", 1.0},
    {"turret_offset_rad", radFromDegrees(1.0)},
    {"thigh_offset_rad", radFromDegrees(1.0)},
    {"shin_offset_rad", radFromDegrees(1.0)},
    {"turret_gain", 0.01},
    {"thigh_gain", 0.01},
    {"shin_gain", 0.01},
    {"turret_quadratic_per_rad", 0.01},
    {"thigh_quadratic_per_rad", 0.01},
    {"shin_quadratic_per_rad", 0.01},
    {"thigh_more_mm", 0.7},
    {"shin_more_mm", 0.7},
    {"gimbal_1_offset_rad", radFromDegrees(2.0)},
    {"gimbal_2_offset_rad", radFromDegrees(2.0)},
    {"gimbal_3_offset_rad", radFromDegrees(2.0)},
    {"gimbal_1_gain", 0.03},
    {"gimbal_2_gain", 0.03},
    {"gimbal_3_gain", 0.03},
    {"shoulder_tilt_rad", radFromDegrees(0.3)},
    {"reach_more_mm", 0.5},
}};
using ArmParameters = std::array<double, kArmParameters.size()>;

/// Which of them a model fits: rigid 6, joint gains and offsets with the tip 15, full 28.
std::vector<std::size_t> parametersOf(ArmModel model);

/// Where all parameters are zero: the arm as its model, or as it is believed to differ from it, standing here.
struct ArmStart {
  PhantomGeometry geometry;
  Pose<World, Device> X_WD;
  Point<World> middle_W;  ///< what the pose parameters turn about
  ArmCorrection correction{};
};

MeasuredArm armOf(const ArmStart& start, const ArmParameters& parameters);

struct TipJacobian {
  glm::dvec3 tip_W_mm{0.0};
  std::array<glm::dvec3, kArmParameters.size()> by_parameter{};  ///< d tip / d number
};
TipJacobian tipJacobian(const ArmStart& start, const ArmParameters& parameters, const RawJoints& raw_rad);

}  // namespace calibration
