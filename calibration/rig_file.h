// The rig file: OpenCV FileStorage YAML, `schema: 1`, `kind: "molar_rig"`. mm, frame W. Start-up only; not the servo.
// Blocks that other parts of calibration add beside these keys are left alone on reading.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/rig.h"

namespace calibration {

/// Throws CalibrationError for a missing, malformed, non-finite or degenerate rig.
Rig readRig(const std::string& path);

/// The text of a rig file; writing it to disk is the caller's.
std::string rigText(const Rig& rig);

}  // namespace calibration
