#include "haptics/device/usb/wooden_kinematics.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::kPi;

glm::dvec3 three(const std::array<std::int16_t, 6>& encoders, std::size_t first) {
  return {encoders[first], encoders[first + 1], encoders[first + 2]};
}

/// The gimbal's encoders lie on the wire from the handle inwards (public driver, "reverse order").
glm::dvec3 reversed(const glm::dvec3& v) { return {v.z, v.y, v.x}; }

}  // namespace

WoodenJoints WoodenKinematics::joints(const std::array<std::int16_t, 6>& encoders) const {
  WoodenJoints joints;
  joints.arm_rad =
      2.0 * kPi * model_.direction * three(encoders, 0) / model_.counts_per_turn * model_.capstan_mm / model_.body_mm;
  if (model_.hasGimbal())
    joints.gimbal_rad =
        2.0 * kPi * model_.gimbal_direction * reversed(three(encoders, 3)) / model_.gimbal_counts_per_turn;
  return joints;
}

calibration::Point<Device> WoodenKinematics::position(const glm::dvec3& arm_rad) const {
  const auto [la, lb, lc] = std::array{model_.length_mm.x, model_.length_mm.y, model_.length_mm.z};
  const double reach_mm = lb * std::sin(arm_rad.y) + lc * std::sin(arm_rad.z);
  const glm::dvec3 p_mm(reach_mm * std::cos(arm_rad.x), reach_mm * std::sin(arm_rad.x),
                        la + lb * std::cos(arm_rad.y) - lc * std::cos(arm_rad.z));
  return {p_mm - model_.origin_mm};
}

calibration::Pose<Device, calibration::Handle> WoodenKinematics::handle(const WoodenJoints& joints) const {
  calibration::Pose<Device, calibration::Handle> X_DH;
  X_DH.translation_mm = position(joints.arm_rad).mm;
  if (!model_.hasGimbal()) return X_DH;
  const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  X_DH.rotation = glm::normalize(glm::angleAxis(joints.arm_rad.x, z) * glm::angleAxis(0.5 * kPi - joints.arm_rad.z, y) *
                                 glm::angleAxis(joints.gimbal_rad.x, x) * glm::angleAxis(joints.gimbal_rad.y, y) *
                                 glm::angleAxis(joints.gimbal_rad.z, x));
  return X_DH;
}

glm::dmat3 WoodenKinematics::jacobian_mm(const glm::dvec3& arm_rad) const {
  const double lb = model_.length_mm.y, lc = model_.length_mm.z;
  const double sa = std::sin(arm_rad.x), ca = std::cos(arm_rad.x);
  const double reach_mm = lb * std::sin(arm_rad.y) + lc * std::sin(arm_rad.z);
  const double b_mm = lb * std::cos(arm_rad.y), c_mm = lc * std::cos(arm_rad.z);
  return {glm::dvec3(-sa * reach_mm, ca * reach_mm, 0.0), glm::dvec3(ca * b_mm, sa * b_mm, -lb * std::sin(arm_rad.y)),
          glm::dvec3(ca * c_mm, sa * c_mm, lc * std::sin(arm_rad.z))};
}

std::array<double, 3> WoodenKinematics::currents_mA(const glm::dvec3& arm_rad,
                                                    const calibration::Vector<Device>& force_D_N) const {
  const glm::dvec3 torque_Nmm = glm::transpose(jacobian_mm(arm_rad)) * force_D_N.xyz;
  glm::dvec3 current_mA =
      1e3 * torque_Nmm * model_.direction * model_.capstan_mm / model_.body_mm / model_.motor_Nmm_per_A;
  const double max_mA = std::max({std::abs(current_mA.x), std::abs(current_mA.y), std::abs(current_mA.z)});
  if (!std::isfinite(max_mA)) return {0.0, 0.0, 0.0};
  if (max_mA > model_.clamp_mA()) current_mA *= model_.clamp_mA() / max_mA;
  return {current_mA.x, current_mA.y, current_mA.z};
}

glm::dvec3 WoodenKinematics::peakTorque_Nmm() const {
  return 1e-3 * model_.clamp_mA() * model_.motor_Nmm_per_A * model_.body_mm / model_.capstan_mm;
}

}  // namespace haptics
