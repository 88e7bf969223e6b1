// The figures and tables of a calibration's report, as markup to put into a page. mm, frame W. Pure.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/fit/arm_fit.h"
#include "calibration/record/drift_review.h"
#include "calibration/record/rig_record.h"

namespace app {

/// What is left at each touch as arrows, larger than life, from where the tip was towards where the arm says it was:
/// seen from the front (x and y) and from the right (z and y, the viewer at the left). `fitted` in grey, what was used
/// against what was set aside told apart; `held_out` in blue.
std::string residualViews(const std::vector<calibration::Residual>& fitted,
                          const std::vector<calibration::Residual>& held_out);

using ExpectedError = std::function<double(const calibration::Point<calibration::World>&)>;
/// The error to be expected over the plane of the screen's image through the site (z = 0), in bands of light to dark
/// blue, with where the touches were.
std::string errorMapView(const ExpectedError& expected_mm,
                         const std::vector<calibration::Point<calibration::World>>& touches_W);

/// The history of a place as a control chart of one quantity, the newest sixty entries: a value at each check, the
/// limits of what is usual, and what broke them.
std::string historyView(const std::vector<calibration::DriftEntry>& history, const calibration::DriftReview& review,
                        calibration::DriftQuantity quantity);

/// Figures against their limits.
std::string figuresTable(const calibration::RigRecord& record);
std::string outliersTable(const calibration::RigRecord& record);
/// Where it comes from.
std::string originTable(const calibration::RigRecord& record, const std::string& now_utc);

}  // namespace app
