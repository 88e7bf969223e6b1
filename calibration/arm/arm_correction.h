// The correction of one arm against its model: sensor readings to joint angles, link lengths and axes, and the position
// of the stylus tip. Frames as phantom_kinematics; mm, rad.
//   angle_i = raw_i (1 + gain_i) + quadratic_i raw_i^2 + offset_i        (no quadratic term in the gimbal)
//   R = reach + l1 c2 + l2 s3,  y' = l1 s2 - l2 c3,  wrist = shoulder + Ry(-turret) (-y' sin tilt, y' cos tilt, R)
// Sources: Harders et al., IEEE TVCG 2009 (gain, offset); Eck et al., ISMAR 2014 (quadratic, gimbal);
// reference/calibration 2.1, 3.1. The gimbal offsets absorb the handle's rotation by the tilt. Pure; any thread, the
// servo's too: no allocation, about 100 flops and 12 trigonometric calls.
#pragma once

#include <array>

#include "calibration/arm/phantom_kinematics.h"

namespace calibration {

/// Sensor readings: turret, thigh, absolute shin, gimbal 1 to 3; rad.
using RawJoints = std::array<double, 6>;

/// Nominal stylus tip of a Phantom: on the stylus axis, in front of the intersection of the gimbal axes.
inline constexpr glm::dvec3 kNominalTip_H_mm{0.0, 0.0, -40.0};

/// Default: all zero and the nominal tip, which is the model itself.
struct ArmCorrection {
  std::array<double, 6> offset_rad{};
  std::array<double, 6> gain{};  ///< relative
  std::array<double, 3> quadratic_per_rad{};
  double thigh_delta_mm = 0.0, shin_delta_mm = 0.0;
  double tilt_rad = 0.0;        ///< shoulder axis against turret axis
  double reach_delta_mm = 0.0;  ///< turret axis to shoulder axis
  glm::dvec3 tip_H_mm = kNominalTip_H_mm;
};

PhantomJoints correctedJoints(const ArmCorrection& correction, const RawJoints& raw_rad);

/// With corrected lengths and angles; equals handlePose(geometry, joints) for a zero correction.
Pose<Device, Handle> handlePose(const PhantomGeometry& geometry, const ArmCorrection& correction,
                                const RawJoints& raw_rad);

/// A measured arm in the world: sensor readings to the tip in W. Plain data; the servo works with a copy.
struct MeasuredArm {
  PhantomGeometry geometry;
  ArmCorrection correction;
  Pose<World, Device> X_WD;

  Pose<Device, Handle> X_DH(const RawJoints& raw_rad) const { return handlePose(geometry, correction, raw_rad); }
  Pose<World, Handle> X_WH(const RawJoints& raw_rad) const { return X_WD * X_DH(raw_rad); }
  Point<World> tip_W(const RawJoints& raw_rad) const { return X_WH(raw_rad) * Point<Handle>{correction.tip_H_mm}; }
};

}  // namespace calibration
