// The blocks that make up the rig itself, out of a YAML file that is being read: screen, mirror, eyes, poses, device,
// kinematics. mm, rad, frame W. A part of rig_file; start-up only. Throws CalibrationError naming key and remedy.
#pragma once

#include <string_view>

#include "calibration/checked_yaml.h"
#include "calibration/rig.h"

namespace calibration {

/// How the arm is computed from its numbers; a file of another kind of arm has another word.
inline constexpr std::string_view kKinematicsKind = "phantom6_v1";

/// Hand-typed matrices are rounded; measured ones are not.
inline constexpr double kTypedRotationTolerance = 1e-3, kMeasuredRotationTolerance = 1e-6;

Rig rigIn(const CheckedYaml& yaml, double rotation_tolerance);

/// A pose and, if it is there, the very quaternion that its matrix was written from (`KEY_wxyz`).
CheckedYaml::Rigid exactPose(const CheckedYaml& yaml, const cv::FileNode& parent, const std::string& key,
                             double rotation_tolerance);

}  // namespace calibration
