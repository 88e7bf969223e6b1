// Where the handle of a Phantom is, from its joint angles, and back. Frame D as its maker has it: x right, y up, z to
// the user; mm, rad. With c, s of turret 1, thigh 2 and shin 3 (absolute: a parallelogram leaves both motors at the
// base), R = l1 c2 + l2 s3 and the shoulder o:
//   x = ox - R s1,  y = oy + l1 s2 - l2 c3,  z = oz + R c1;   |det J| = R l1 l2 |cos(shin - thigh)|
//   R_DH = Ry(-turret) Rx(-shin) Ry(g1) Rx(-g2) Rz(-g3)
// Sources: Harders et al., IEEE TVCG 2009; Cavusoglu, Feygin, Tendick, Presence 2002 (same structure);
// reference/devices 4.1, 4.2. Pure; any thread, the servo's too; about fifty flops. All of a geometry are plain numbers
// that a fit may vary; an angle here is the mechanism's own, after any correction of what its sensors read.
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
  Point<Device> shoulder_D;         ///< where the axes of turret and thigh meet
  std::array<AngleRange, 3> arm;    ///< turret, thigh, shin
  AngleRange elbow;                 ///< shin less thigh
  std::array<AngleRange, 3> wrist;  ///< g1, g2, g3
};

struct PhantomJoints {
  glm::dvec3 arm_rad{0.0};    ///< turret, thigh, absolute shin
  glm::dvec3 wrist_rad{0.0};  ///< the gimbal: right +, up -, clockwise +
};

Point<Device> wristPosition(const PhantomGeometry& geometry, const glm::dvec3& arm_rad);
Pose<Device, Handle> handlePose(const PhantomGeometry& geometry, const PhantomJoints& joints);

/// dx = J dq of the arm, mm/rad; columns turret, thigh, shin.
glm::dmat3 armJacobian_mm(const PhantomGeometry& geometry, const glm::dvec3& arm_rad);

/// J^T F: what its three motors give for a force on the hand.
glm::dvec3 armTorque_Nmm(const PhantomGeometry& geometry, const glm::dvec3& arm_rad, const Vector<Device>& force_D_N);

bool withinLimits(const PhantomGeometry& geometry, const glm::dvec3& arm_rad);

/// Of the up to four ways to reach a place, turret before or behind and elbow up or down, the one within the limits.
std::optional<glm::dvec3> armAnglesFor(const PhantomGeometry& geometry, const Point<Device>& wrist_D);

/// The gimbal's angles that turn the handle so, whatever the limits; up and down within a right angle.
glm::dvec3 wristAnglesFor(const glm::dvec3& arm_rad, const glm::dquat& R_DH);

/// None where arm or gimbal would be beyond its limits.
std::optional<PhantomJoints> jointsReaching(const PhantomGeometry& geometry, const Pose<Device, Handle>& X_DH);

}  // namespace calibration
