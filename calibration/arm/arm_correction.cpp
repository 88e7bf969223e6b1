#include "calibration/arm/arm_correction.h"

#include <cmath>

namespace calibration {

PhantomJoints correctedJoints(const ArmCorrection& correction, const RawJoints& raw_rad) {
  PhantomJoints joints;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    joints.arm_rad[axis] = raw_rad[i] * (1.0 + correction.gain[i]) + correction.offset_rad[i] +
                           correction.quadratic_per_rad[i] * raw_rad[i] * raw_rad[i];
    joints.wrist_rad[axis] = raw_rad[i + 3] * (1.0 + correction.gain[i + 3]) + correction.offset_rad[i + 3];
  }
  return joints;
}

Pose<Device, Handle> handlePose(const PhantomGeometry& geometry, const ArmCorrection& correction,
                                const RawJoints& raw_rad) {
  const PhantomJoints joints = correctedJoints(correction, raw_rad);
  PhantomGeometry measured = geometry;
  measured.thigh_mm += correction.thigh_delta_mm;
  measured.shin_mm += correction.shin_delta_mm;
  Pose<Device, Handle> X_DH = handlePose(measured, joints);

  // Reach and tilt affect the wrist's position only: rotate it out of the turret, move it, rotate it back.
  if (correction.reach_delta_mm == 0.0 && correction.tilt_rad == 0.0) return X_DH;
  const double s1 = std::sin(joints.arm_rad.x), c1 = std::cos(joints.arm_rad.x);
  const glm::dvec3 from_shoulder = X_DH.translation_mm - geometry.shoulder_D.mm;
  const double out_mm = correction.reach_delta_mm - s1 * from_shoulder.x + c1 * from_shoulder.z;
  const double across_mm = -std::sin(correction.tilt_rad) * from_shoulder.y;
  const double up_mm = std::cos(correction.tilt_rad) * from_shoulder.y;
  X_DH.translation_mm =
      geometry.shoulder_D.mm + glm::dvec3(c1 * across_mm - s1 * out_mm, up_mm, s1 * across_mm + c1 * out_mm);
  return X_DH;
}

}  // namespace calibration
