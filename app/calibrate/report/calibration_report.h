// A calibration as one HTML page for the records: verdict and largest error first, then figures against their limits,
// where the error is, its history, and the origin of the data. No other file, no script; readable in print and without
// colour. Names no person. mm, frame W. Pure; any thread but the servo; milliseconds.
#pragma once

#include <string>
#include <vector>

#include "calibration/record/drift_history.h"
#include "calibration/record/rig_record.h"

namespace app {

/// `history`: of this rig and device, oldest first; may be empty. `now_utc`: for the age, "2026-11-21T08:20:00Z".
std::string reportHtml(const calibration::RigRecord& record, const std::vector<calibration::DriftEntry>& history,
                       const std::string& now_utc);

}  // namespace app
