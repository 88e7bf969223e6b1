// Differences between two rigs, one line each with both values and unit. mm, degrees. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/record/rig_record.h"

namespace calibration {

/// Order: metadata, arm, surroundings. Empty: no difference as printed.
std::vector<std::string> differences(const RigRecord& before, const RigRecord& after);

}  // namespace calibration
