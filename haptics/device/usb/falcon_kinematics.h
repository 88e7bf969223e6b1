// Kinematics of the Novint Falcon's three legs: encoders to leg angles, leg angles to the grip, the Jacobian. A leg: a
// thigh of length a turns about a fixed axis; from its knee two links and a parallelogram shin of length b lead to the
// grip, which never rotates. With X, Z across and out of the base and V along the axis, of the shin's end in the leg's
// frame:  |(X - a cos t, Z - a sin t)| = d + e + sqrt(b^2 - V^2). Frame D: the base's centre, z out of it towards the
// hand, y up, x right (as public code has it; never checked on a unit); mm, rad. Any thread; no allocation; forward at
// most 15 Newton steps, a few us. Source: R. Stamper, PhD 97-4, Maryland; libnifalcon/libnifalcon, FalconGeometry.h,
// FalconKinematic.h (facts; reference/devices 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

using FalconLegs = glm::dvec3;  ///< angles of the three thighs, rad

FalconLegs falconLegs_rad(const std::array<std::int16_t, 3>& encoders);

/// Forward kinematics from a start near the grip, to 1e-10 mm; none when it does not converge.
std::optional<calibration::Point<calibration::Device>> falconGrip(
    const FalconLegs& legs_rad, const calibration::Point<calibration::Device>& near_D);

/// mm/rad, columns as legs; torque = J^T F. Zero where the legs are singular.
glm::dmat3 falconJacobian_mm(const FalconLegs& legs_rad, const calibration::Point<calibration::Device>& grip_D);

/// The grip in the middle of the workspace.
calibration::Point<calibration::Device> falconMiddle();

}  // namespace haptics
