// The rig file: OpenCV FileStorage YAML, `schema: 1`, `kind: "molar_rig"`; blocks screen, mirror, eyes, X_WP, X_WD, and
// beside them whatever is known: provenance, device, kinematics, procedure, verification, residuals, rest, and last the
// hash of all that stands before it. mm, frame W. Start-up only; not the servo. Keys that are not known are left alone.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/record/rig_record.h"

namespace calibration {

/// Throws CalibrationError, one line with file, key and remedy: missing, truncated, malformed, not finite, not rigid,
/// degenerate, of a newer schema, or edited since its hash was written. A file without a hash is taken as typed by
/// hand.
RigRecord readRigRecord(const std::string& path);
Rig readRig(const std::string& path);

/// The text of a rig file; writing it to disk is the caller's. With its hash at the end.
std::string rigRecordText(const RigRecord& record);
/// Without a hash and without blocks that a plain rig does not have: for a person to edit.
std::string rigText(const Rig& rig);

}  // namespace calibration
