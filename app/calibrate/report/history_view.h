// The history of a place as a control chart: one value at each check, the limits of what is usual, and what broke them.
// mm. Pure.
#pragma once

#include <string>
#include <vector>

#include "calibration/record/drift_review.h"

namespace app {

/// One quantity, the newest sixty entries.
std::string historyView(const std::vector<calibration::DriftEntry>& history, const calibration::DriftReview& review,
                        calibration::DriftQuantity quantity);

}  // namespace app
