// The Novint Falcon's three legs: encoders to leg angles, leg angles to the grip and back, and the Jacobian that turns
// a force into torques. A leg: a thigh of length a turns about a fixed axis; from its knee two links and a
// parallelogram shin of length b lead to the grip, which never turns. With X, Z across and out of the base and V along
// the axis, of the shin's end in the leg's own frame:  |(X - a cos t, Z - a sin t)| = d + e + sqrt(b^2 - V^2). Frame D:
// the base's centre, z out of it towards the hand, y up, x right (as public code has it; never checked on a unit); mm,
// rad. Any thread; no allocation; forward at most 15 steps of Newton, a few us. Source: R. Stamper, PhD 97-4, Maryland;
// libnifalcon/libnifalcon, FalconGeometry.h, FalconKinematic.h (facts; reference/devices 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

using FalconLegs = glm::dvec3;  ///< angles of the three thighs, rad

FalconLegs falconLegs_rad(const std::array<std::int16_t, 3>& encoders);

/// Inverse kinematics, closed form; none where a leg does not reach.
std::optional<FalconLegs> falconLegsAt_rad(const calibration::Point<calibration::Device>& grip_D);

/// Forward kinematics from a grip nearby, to 1e-10 mm; none when the angles belong to no grip near it.
std::optional<calibration::Point<calibration::Device>> falconGrip(
    const FalconLegs& legs_rad, const calibration::Point<calibration::Device>& near_D);

/// mm/rad, columns as legs; torque = J^T F. Zero where the legs are singular.
glm::dmat3 falconJacobian_mm(const FalconLegs& legs_rad, const calibration::Point<calibration::Device>& grip_D);

/// A grip in the middle of the workspace, to start from.
calibration::Point<calibration::Device> falconMiddle();

}  // namespace haptics
