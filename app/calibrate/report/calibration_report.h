// A calibration as one HTML page, for the technician's binder and whoever asks how good the rig is: verdict and the one
// sentence first, then figures against their limits, where the error is, how it went over the weeks, and where all this
// comes from. No other file, no script, readable in print and without colours. Names no person: who measured is a code.
// mm, frame W. Pure; any thread but the servo's; milliseconds.
#pragma once

#include <string>
#include <vector>

#include "calibration/record/drift_history.h"
#include "calibration/record/rig_record.h"

namespace app {

/// `history`: of the record's place, oldest first; empty: none yet. `now_utc`: for the age, "2026-11-21T08:20:00Z".
std::string reportHtml(const calibration::RigRecord& record, const std::vector<calibration::DriftEntry>& history,
                       const std::string& now_utc);

}  // namespace app
