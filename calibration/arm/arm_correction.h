// How one arm differs from its model: what its sensors read to the angles of its mechanism, its lengths and axes, and
// where the tip of its stylus stands. Frames as phantom_kinematics; mm, rad.
//   angle_i = raw_i (1 + gain_i) + quadratic_i raw_i^2 + offset_i        (the gimbal has no quadratic term)
//   R = reach + l1 c2 + l2 s3,  y' = l1 s2 - l2 c3,  wrist = shoulder + Ry(-turret) (-y' sin tilt, y' cos tilt, R)
// Sources: Harders et al., IEEE TVCG 2009 (gain, offset); Eck et al., ISMAR 2014 (quadratic, gimbal);
// reference/calibration 2.1, 3.1. The handle's own turn by the tilt is taken up by the gimbal's offsets.
// Pure; any thread, the servo's too: no allocation, about 100 flops and 12 trigonometric calls.
#pragma once

#include <array>

#include "calibration/arm/phantom_kinematics.h"

namespace calibration {

/// What the sensors say: turret, thigh, absolute shin, gimbal 1 to 3; rad.
using RawJoints = std::array<double, 6>;

/// Where a Phantom's stylus ends, nominally: on its axis, in front of where the gimbal's axes meet.
inline constexpr glm::dvec3 kNominalTip_H_mm{0.0, 0.0, -40.0};

/// All zero and the nominal tip: the model itself.
struct ArmCorrection {
  std::array<double, 6> offset_rad{};
  std::array<double, 6> gain{};  ///< relative
  std::array<double, 3> quadratic_per_rad{};
  double thigh_delta_mm = 0.0, shin_delta_mm = 0.0;
  double tilt_rad = 0.0;        ///< of the shoulder's axis against the turret's
  double reach_delta_mm = 0.0;  ///< from the turret's axis to the shoulder's
  glm::dvec3 tip_H_mm = kNominalTip_H_mm;
};

/// The mechanism's own angles.
PhantomJoints correctedJoints(const ArmCorrection& correction, const RawJoints& raw_rad);

/// With corrected lengths and angles; equal to handlePose(geometry, joints) where the correction is none.
Pose<Device, Handle> handlePose(const PhantomGeometry& geometry, const ArmCorrection& correction,
                                const RawJoints& raw_rad);

/// An arm as it was measured, where it stands: all that is needed from sensors to the tip in the surgeon's image.
/// Plain data: a copy is the immutable snapshot that the servo works with.
struct MeasuredArm {
  PhantomGeometry geometry;
  ArmCorrection correction;
  Pose<World, Device> X_WD;

  Pose<Device, Handle> X_DH(const RawJoints& raw_rad) const { return handlePose(geometry, correction, raw_rad); }
  Pose<World, Handle> X_WH(const RawJoints& raw_rad) const { return X_WD * X_DH(raw_rad); }
  Point<World> tip_W(const RawJoints& raw_rad) const { return X_WH(raw_rad) * Point<Handle>{correction.tip_H_mm}; }
};

}  // namespace calibration
