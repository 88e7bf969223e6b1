// What checks have found of a rig since it was measured. A check that is worse than the rig's own verification stands
// in its place: a base that was pushed is not green because it once was. mm. Pure; any thread.
#pragma once

#include <vector>

#include "calibration/record/drift_history.h"
#include "calibration/record/rig_record.h"

namespace calibration {

/// `record` with the newest check since then as its verification, where that is worse. A history knows mean square and
/// bias of a check alone: its 95 % and its largest error are put as large as its RMS, which they are at least.
RigRecord withLaterCheck(RigRecord record, const std::vector<DriftEntry>& history);

}  // namespace calibration
