// What differs between two rigs, for people: a line each, with both values and their unit. mm, degrees. Pure; any
// thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/record/rig_record.h"

namespace calibration {

/// In the order of who, arm, surroundings; empty: what is written of them is the same.
std::vector<std::string> differences(const RigRecord& before, const RigRecord& after);

}  // namespace calibration
