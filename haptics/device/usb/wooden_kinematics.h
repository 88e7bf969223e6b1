// Kinematics of a WoodenHaptics: handle pose from its encoders, motor currents for a force. With the reach
// R = Lb sin b + Lc sin c:  x = R cos a - ox,  y = R sin a - oy,  z = La + Lb cos b - Lc cos c - oz;
// rotation Rz(a) Ry(pi/2 - c) Rx(d) Ry(e) Rx(f). Forearm and upper arm are both driven from the base: b, c absolute.
// Frame D: x out of the base towards the user, z up, origin in the middle of the workspace; mm, rad, N, N mm, mA. Any
// thread; a few dozen flops, no allocation. Facts of forsslund/haptikfabrikenapi, src/kinematics.cpp (reference/devices
// 3.1).
#pragma once

#include <array>
#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/device/usb/wooden_model.h"

namespace haptics {

struct WoodenJoints {
  glm::dvec3 arm_rad{0.0};     ///< a, b, c
  glm::dvec3 gimbal_rad{0.0};  ///< d, e, f
};

class WoodenKinematics {
 public:
  explicit WoodenKinematics(const WoodenModel& model) : model_(model) {}

  WoodenJoints joints(const std::array<std::int16_t, 6>& encoders) const;

  calibration::Pose<calibration::Device, calibration::Handle> handle(const WoodenJoints& joints) const;
  calibration::Point<calibration::Device> position(const glm::dvec3& arm_rad) const;

  /// mm/rad, columns as joints a, b, c.
  glm::dmat3 jacobian_mm(const glm::dvec3& arm_rad) const;
  /// For a force on the hand: joint torques J^T F, through the capstans. Beyond the clamp all three are scaled alike,
  /// so that the force keeps its direction.
  std::array<double, 3> currents_mA(const glm::dvec3& arm_rad,
                                    const calibration::Vector<calibration::Device>& force_D_N) const;
  /// Joint torques at the clamp current.
  glm::dvec3 peakTorque_Nmm() const;

 private:
  WoodenModel model_;
};

}  // namespace haptics
