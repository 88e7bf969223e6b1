// The blocks that say how a rig is known, out of a YAML file that is being read: provenance, procedure, fit,
// verification, residuals, rest. All may be missing. mm, frame W. A part of rig_file; start-up only. Throws
// CalibrationError naming key and remedy.
#pragma once

#include "calibration/checked_yaml.h"
#include "calibration/record/rig_record.h"

namespace calibration {

void readMetadata(const CheckedYaml& yaml, double rotation_tolerance, RigRecord& record);

}  // namespace calibration
