// Forward and inverse kinematics and Jacobian of a Phantom. Frame D as the maker defines it: x right, y up, z to the
// user; mm, rad. With c, s of turret 1, thigh 2 and shin 3 (absolute: a parallelogram leaves both motors at the base),
// R = l1 c2 + l2 s3 and the shoulder o:
//   x = ox - R s1,  y = oy + l1 s2 - l2 c3,  z = oz + R c1;
//   det J = R l1 l2 cos(shin - thigh)
#pragma once

#include <array>
#include <optional>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace calibration {

struct AngleRange {
  double min_rad = -1e3, max_rad = 1e3;

  bool contains(double angle_rad) const { return angle_rad >= min_rad && angle_rad <= max_rad; }
};

struct PhantomGeometry {
  double thigh_mm = 0.0, shin_mm = 0.0;
  Point<Device> shoulder_D;         ///< intersection of turret and thigh axes
  std::array<AngleRange, 3> arm;    ///< turret, thigh, shin
  AngleRange elbow;                 ///< shin minus thigh
  std::array<AngleRange, 3> wrist;  ///< g1, g2, g3
};

struct PhantomJoints {
  glm::dvec3 arm_rad{0.0};    ///< turret, thigh, absolute shin
  glm::dvec3 wrist_rad{0.0};  ///< the gimbal: right +, up -, clockwise +
};

Point<Device> wristPosition(const PhantomGeometry& geometry, const glm::dvec3& arm_rad);
Pose<Device, Handle> handlePose(const PhantomGeometry& geometry, const PhantomJoints& joints);

/// dx = J dq, mm/rad; columns turret, thigh, shin.
glm::dmat3 armJacobian_mm(const PhantomGeometry& geometry, const glm::dvec3& arm_rad);

/// J^T F: the torques of the three motors for a force on the hand.
glm::dvec3 armTorque_Nmm(const PhantomGeometry& geometry, const glm::dvec3& arm_rad, const Vector<Device>& force_D_N);

bool withinLimits(const PhantomGeometry& geometry, const glm::dvec3& arm_rad);

/// The solution within the limits, of up to four (turret in front or behind, elbow up or down).
std::optional<glm::dvec3> armAnglesFor(const PhantomGeometry& geometry, const Point<Device>& wrist_D);

/// Gimbal angles for this orientation of the handle, limits ignored; the second angle within ±90 degrees.
glm::dvec3 wristAnglesFor(const glm::dvec3& arm_rad, const glm::dquat& R_DH);

/// None: outside the limits of arm or gimbal.
std::optional<PhantomJoints> jointsReaching(const PhantomGeometry& geometry, const Pose<Device, Handle>& X_DH);

}  // namespace calibration
