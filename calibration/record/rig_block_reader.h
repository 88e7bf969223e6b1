// Parts of reading a rig file: the rig itself (screen, mirror, eyes, poses, device, kinematics) and its metadata. mm,
// rad, frame W. Start-up only. Throws CalibrationError naming key and remedy.
#pragma once

#include <string_view>

#include "calibration/checked_yaml.h"
#include "calibration/record/rig_record.h"

namespace calibration {

/// The kinematic model of `kinematics`; another kind of arm would have another name.
inline constexpr std::string_view kKinematicsKind = "phantom6_v1";

/// Manually entered matrices are rounded.
inline constexpr double kTypedRotationTolerance = 1e-3, kMeasuredRotationTolerance = 1e-6;

Rig rigIn(const CheckedYaml& yaml, double rotation_tolerance);

/// A pose, from its exact quaternion (`KEY_wxyz`) if present.
CheckedYaml::Rigid exactPose(const CheckedYaml& yaml, const cv::FileNode& parent, const std::string& key,
                             double rotation_tolerance);

/// How the rig was measured: provenance, procedure, fit, verification, residuals, rest; all optional.
void readMetadata(const CheckedYaml& yaml, double rotation_tolerance, RigRecord& record);

}  // namespace calibration
