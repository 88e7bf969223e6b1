#include "calibration/fit/arm_parameters.h"

#include <cmath>

#include "calibration/geometry/rotation.h"

namespace calibration {
namespace {

constexpr std::size_t kRotation = 0, kTranslation = 3, kTip = 6, kOffset = 9, kGain = 12, kQuadratic = 15, kThigh = 18,
                      kShin = 19, kGimbalOffset = 20, kGimbalGain = 23, kTilt = 26, kReach = 27;

glm::dvec3 three(const ArmParameters& parameters, std::size_t first) {
  return {parameters[first], parameters[first + 1], parameters[first + 2]};
}

/// d exp(r) p / dr = -[exp(r) p]x times this: the left Jacobian of rotations.
glm::dmat3 leftJacobian(const glm::dvec3& rotation_rad) {
  const double a = glm::length(rotation_rad);
  if (a < 1e-8) return glm::dmat3(1.0);
  const glm::dvec3 u = rotation_rad / a;
  return std::sin(a) / a * glm::dmat3(1.0) + (1.0 - std::cos(a)) / a * crossMatrix(u) +
         (1.0 - std::sin(a) / a) * glm::outerProduct(u, u);
}

ArmCorrection corrected(ArmCorrection correction, const ArmParameters& parameters) {
  for (std::size_t i = 0; i < 3; ++i) {
    correction.offset_rad[i] += parameters[kOffset + i];
    correction.offset_rad[i + 3] += parameters[kGimbalOffset + i];
    correction.gain[i] += parameters[kGain + i];
    correction.gain[i + 3] += parameters[kGimbalGain + i];
    correction.quadratic_per_rad[i] += parameters[kQuadratic + i];
  }
  correction.thigh_delta_mm += parameters[kThigh];
  correction.shin_delta_mm += parameters[kShin];
  correction.tilt_rad += parameters[kTilt];
  correction.reach_delta_mm += parameters[kReach];
  correction.tip_H_mm += three(parameters, kTip);
  return correction;
}

/// Derivatives of the tip in D by the six angles, the lengths, tilt and reach.
struct DeviceSlopes {
  glm::dvec3 tip_D;
  std::array<glm::dvec3, 6> by_angle;
  glm::dvec3 by_thigh, by_shin, by_tilt, by_reach;
  glm::dmat3 R_DH;

  DeviceSlopes(const MeasuredArm& arm, const RawJoints& raw_rad) {
    const PhantomJoints joints = correctedJoints(arm.correction, raw_rad);
    const Pose<Device, Handle> X_DH = arm.X_DH(raw_rad);
    R_DH = glm::mat3_cast(X_DH.rotation);
    const glm::dvec3 lever = R_DH * arm.correction.tip_H_mm;
    tip_D = X_DH.translation_mm + lever;

    const double s1 = std::sin(joints.arm_rad.x), c1 = std::cos(joints.arm_rad.x), s2 = std::sin(joints.arm_rad.y),
                 c2 = std::cos(joints.arm_rad.y), s3 = std::sin(joints.arm_rad.z), c3 = std::cos(joints.arm_rad.z),
                 st = std::sin(arm.correction.tilt_rad), ct = std::cos(arm.correction.tilt_rad);
    const double l1 = arm.geometry.thigh_mm + arm.correction.thigh_delta_mm,
                 l2 = arm.geometry.shin_mm + arm.correction.shin_delta_mm, up_mm = l1 * s2 - l2 * c3;
    const auto out_of_turret = [&](double across, double up, double out) {
      return glm::dvec3(c1 * across - s1 * out, up, s1 * across + c1 * out);
    };
    const auto in_arm_plane = [&](double up, double out) { return out_of_turret(-up * st, up * ct, out); };
    by_thigh = in_arm_plane(s2, c2);
    by_shin = in_arm_plane(-c3, s3);
    by_tilt = out_of_turret(-up_mm * ct, -up_mm * st, 0.0);
    by_reach = in_arm_plane(0.0, 1.0);

    // Turret: everything; thigh: the wrist; shin: the wrist and the handle's rotation; gimbal: the handle's rotation.
    const double sg = std::sin(joints.wrist_rad.x), cg = std::cos(joints.wrist_rad.x);
    const glm::dvec3 shin_axis(-c1, 0.0, -s1), yaw_axis(s1 * s3, c3, -c1 * s3);
    const glm::dvec3 forward = glm::cross(-shin_axis, yaw_axis);
    by_angle[0] = glm::cross(glm::dvec3(0.0, -1.0, 0.0), tip_D - arm.geometry.shoulder_D.mm);
    by_angle[1] = in_arm_plane(l1 * c2, -l1 * s2);
    by_angle[2] = in_arm_plane(l2 * s3, l2 * c3) + glm::cross(shin_axis, lever);
    by_angle[3] = glm::cross(yaw_axis, lever);
    by_angle[4] = glm::cross(cg * shin_axis + sg * forward, lever);
    by_angle[5] = glm::cross(-R_DH[2], lever);
  }
};

}  // namespace

std::vector<std::size_t> parametersOf(ArmModel model) {
  const std::size_t count = model == ArmModel::rigid ? kTip : model == ArmModel::joint_gains ? kQuadratic : kReach + 1;
  std::vector<std::size_t> parameters(count);
  for (std::size_t i = 0; i < count; ++i) parameters[i] = i;
  return parameters;
}

MeasuredArm armOf(const ArmStart& start, const ArmParameters& parameters) {
  const glm::dquat rotation = rotationFromVector(three(parameters, kRotation));
  const glm::dvec3 from_middle_mm = start.X_WD.translation_mm - start.middle_W.mm;
  return {start.geometry,
          corrected(start.correction, parameters),
          {glm::normalize(rotation * start.X_WD.rotation),
           start.middle_W.mm + rotation * from_middle_mm + three(parameters, kTranslation)}};
}

TipJacobian tipJacobian(const ArmStart& start, const ArmParameters& parameters, const RawJoints& raw_rad) {
  const MeasuredArm arm = armOf(start, parameters);
  const DeviceSlopes in_D(arm, raw_rad);
  const glm::dmat3 R_WD = glm::mat3_cast(arm.X_WD.rotation);
  TipJacobian slopes;
  slopes.tip_W_mm = R_WD * in_D.tip_D + arm.X_WD.translation_mm;

  // The rotation's lever: from the centre to the tip before the translation.
  const glm::dvec3 from_middle_mm = slopes.tip_W_mm - three(parameters, kTranslation) - start.middle_W.mm;
  const glm::dmat3 left = leftJacobian(three(parameters, kRotation));
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    slopes.by_parameter[kRotation + i] = glm::cross(left[axis], from_middle_mm);
    slopes.by_parameter[kTranslation + i][axis] = 1.0;
    slopes.by_parameter[kTip + i] = R_WD * in_D.R_DH[axis];
    const glm::dvec3 by_arm = R_WD * in_D.by_angle[i], by_wrist = R_WD * in_D.by_angle[i + 3];
    slopes.by_parameter[kOffset + i] = by_arm;
    slopes.by_parameter[kGain + i] = raw_rad[i] * by_arm;
    slopes.by_parameter[kQuadratic + i] = raw_rad[i] * raw_rad[i] * by_arm;
    slopes.by_parameter[kGimbalOffset + i] = by_wrist;
    slopes.by_parameter[kGimbalGain + i] = raw_rad[i + 3] * by_wrist;
  }
  slopes.by_parameter[kThigh] = R_WD * in_D.by_thigh;
  slopes.by_parameter[kShin] = R_WD * in_D.by_shin;
  slopes.by_parameter[kTilt] = R_WD * in_D.by_tilt;
  slopes.by_parameter[kReach] = R_WD * in_D.by_reach;
  return slopes;
}

}  // namespace calibration
