// A check made after the calibration overrides its verification if it was worse: a base that was pushed later is not
// green. mm. Pure; any thread.
#pragma once

#include <vector>

#include "calibration/record/drift_history.h"
#include "calibration/record/rig_record.h"

namespace calibration {

/// `record` with the latest check as its verification, if worse. The history has RMS and bias only: the 95 % and
/// largest errors are set to the RMS, their lower bound.
RigRecord withLaterCheck(RigRecord record, const std::vector<DriftEntry>& history);

}  // namespace calibration
