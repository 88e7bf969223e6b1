#include "calibration/arm/phantom_kinematics.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace calibration {
namespace {

/// Sines and cosines of the arm, and the wrist's distance from the turret axis.
struct Arm {
  double s1, c1, s2, c2, s3, c3, out_mm;

  Arm(const PhantomGeometry& g, const glm::dvec3& q)
      : s1(std::sin(q.x)),
        c1(std::cos(q.x)),
        s2(std::sin(q.y)),
        c2(std::cos(q.y)),
        s3(std::sin(q.z)),
        c3(std::cos(q.z)),
        out_mm(g.thigh_mm * c2 + g.shin_mm * s3) {}
};

glm::dquat aboutX(double angle_rad) { return {std::cos(0.5 * angle_rad), std::sin(0.5 * angle_rad), 0.0, 0.0}; }
glm::dquat aboutY(double angle_rad) { return {std::cos(0.5 * angle_rad), 0.0, std::sin(0.5 * angle_rad), 0.0}; }
glm::dquat aboutZ(double angle_rad) { return {std::cos(0.5 * angle_rad), 0.0, 0.0, std::sin(0.5 * angle_rad)}; }

glm::dquat armRotation(const glm::dvec3& arm_rad) { return aboutY(-arm_rad.x) * aboutX(-arm_rad.z); }

/// Shifted by whole turns into the range, if possible.
double turnedInto(const AngleRange& range, double angle_rad) {
  for (double rotations : {0.0, -2.0 * kPi, 2.0 * kPi})
    if (range.contains(angle_rad + rotations)) return angle_rad + rotations;
  return angle_rad;
}

}  // namespace

Point<Device> wristPosition(const PhantomGeometry& geometry, const glm::dvec3& arm_rad) {
  const Arm a(geometry, arm_rad);
  const glm::dvec3& o = geometry.shoulder_D.mm;
  return {{o.x - a.out_mm * a.s1, o.y + geometry.thigh_mm * a.s2 - geometry.shin_mm * a.c3, o.z + a.out_mm * a.c1}};
}

Pose<Device, Handle> handlePose(const PhantomGeometry& geometry, const PhantomJoints& joints) {
  const glm::dvec3& g = joints.wrist_rad;
  return {armRotation(joints.arm_rad) * aboutY(g.x) * aboutX(-g.y) * aboutZ(-g.z),
          wristPosition(geometry, joints.arm_rad).mm};
}

glm::dmat3 armJacobian_mm(const PhantomGeometry& geometry, const glm::dvec3& arm_rad) {
  const Arm a(geometry, arm_rad);
  const double l1 = geometry.thigh_mm, l2 = geometry.shin_mm;
  return {glm::dvec3(-a.out_mm * a.c1, 0.0, -a.out_mm * a.s1), l1 * glm::dvec3(a.s2 * a.s1, a.c2, -a.s2 * a.c1),
          l2 * glm::dvec3(-a.c3 * a.s1, a.s3, a.c3 * a.c1)};
}

glm::dvec3 armTorque_Nmm(const PhantomGeometry& geometry, const glm::dvec3& arm_rad, const Vector<Device>& force_D_N) {
  return glm::transpose(armJacobian_mm(geometry, arm_rad)) * force_D_N.xyz;
}

bool withinLimits(const PhantomGeometry& geometry, const glm::dvec3& arm_rad) {
  return geometry.arm[0].contains(arm_rad.x) && geometry.arm[1].contains(arm_rad.y) &&
         geometry.arm[2].contains(arm_rad.z) && geometry.elbow.contains(arm_rad.z - arm_rad.y);
}

std::optional<glm::dvec3> armAnglesFor(const PhantomGeometry& geometry, const Point<Device>& wrist_D) {
  const double l1 = geometry.thigh_mm, l2 = geometry.shin_mm;
  const glm::dvec3 away = wrist_D.mm - geometry.shoulder_D.mm;
  const double out_mm = std::hypot(away.x, away.z), up_mm = away.y;
  const double cos_bend = (out_mm * out_mm + up_mm * up_mm - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);
  if (!(std::abs(cos_bend) <= 1.0)) return std::nullopt;
  const double turret = std::atan2(-away.x, away.z);

  // The shin's angle is measured from hanging down, the bend's from straight out.
  for (double side : {1.0, -1.0})
    for (double bend : {-std::acos(cos_bend), std::acos(cos_bend)}) {
      const double thigh = std::atan2(up_mm, side * out_mm) - std::atan2(l2 * std::sin(bend), l1 + l2 * cos_bend);
      const double behind = side > 0.0 ? 0.0 : (turret > 0.0 ? -kPi : kPi);
      glm::dvec3 arm_rad(turnedInto(geometry.arm[0], turret + behind), turnedInto(geometry.arm[1], thigh), 0.0);
      arm_rad.z = turnedInto(geometry.arm[2], arm_rad.y + bend + 0.5 * kPi);
      if (withinLimits(geometry, arm_rad)) return arm_rad;
    }
  return std::nullopt;
}

glm::dvec3 wristAnglesFor(const glm::dvec3& arm_rad, const glm::dquat& R_DH) {
  // Ry(a) Rx(b) Rz(c), from its matrix; GLM is column-major.
  const glm::dmat3 m = glm::mat3_cast(glm::conjugate(armRotation(arm_rad)) * R_DH);
  return {std::atan2(m[2][0], m[2][2]), std::asin(std::clamp(m[2][1], -1.0, 1.0)), -std::atan2(m[0][1], m[1][1])};
}

std::optional<PhantomJoints> jointsReaching(const PhantomGeometry& geometry, const Pose<Device, Handle>& X_DH) {
  const auto arm_rad = armAnglesFor(geometry, {X_DH.translation_mm});
  if (!arm_rad) return std::nullopt;
  const PhantomJoints joints{*arm_rad, wristAnglesFor(*arm_rad, X_DH.rotation)};
  for (int axis = 0; axis < 3; ++axis)
    if (!geometry.wrist[static_cast<std::size_t>(axis)].contains(joints.wrist_rad[axis])) return std::nullopt;
  return joints;
}

}  // namespace calibration
