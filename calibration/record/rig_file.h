// The rig file: OpenCV FileStorage YAML, `schema: 1`, `kind: "molar_rig"`; blocks screen, mirror, eyes, X_WP, X_WD, and
// optionally provenance, device, kinematics, procedure, verification, residuals, rest, patient, and last a hash of all
// bytes before it. mm, frame W. Start-up only. Unknown keys are ignored.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/record/rig_record.h"

namespace calibration {

/// Throws CalibrationError with file, key and remedy: missing, truncated, malformed, not finite, not rigid, degenerate,
/// newer schema, or edited since its hash was written. A file without a hash counts as hand-written.
RigRecord readRigRecord(const std::string& path);
Rig readRig(const std::string& path);

/// The text of a rig file with its hash; the caller writes it.
std::string rigRecordText(const RigRecord& record);
/// A plain rig without hash and metadata, for a person to edit.
std::string rigText(const Rig& rig);

}  // namespace calibration
