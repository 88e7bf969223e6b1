// The rig that a calibration starts from or is proved with, as people name it, and its device's arm. Start-up only.
#pragma once

#include <string>

#include "calibration/fit/touches.h"
#include "calibration/record/rig_record.h"

namespace app {

inline constexpr const char* kBaseRigHelp = "Rig file, or mirrored or desktop as they come with the program";

/// Throws CalibrationError as readRigRecord.
calibration::RigRecord baseRig(const std::string& named);

/// The arm of the rig, or the model's own where none was measured. Throws CalibrationError when the touches are of
/// another device than the rig's.
calibration::MeasuredArm armOf(const calibration::RigRecord& record, const calibration::TouchSet& touches,
                               const std::string& named);

}  // namespace app
