// Figures and tables of the calibration report, as markup. mm, frame W. Pure.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/fit/arm_fit.h"
#include "calibration/record/drift_review.h"
#include "calibration/record/rig_record.h"

namespace app {

/// Residuals as enlarged arrows from the touched target towards the tip computed by the arm: from the front (x, y) and
/// from the right (z, y; viewer at the left). `fitted` in grey, touches set aside marked; `held_out` in blue.
std::string residualViews(const std::vector<calibration::Residual>& fitted,
                          const std::vector<calibration::Residual>& held_out);

using ExpectedError = std::function<double(const calibration::Point<calibration::World>&)>;
/// The expected error over the plane z = 0 through the site, in bands of light to dark blue, with the touches.
std::string errorMapView(const ExpectedError& expected_mm,
                         const std::vector<calibration::Point<calibration::World>>& touches_W);

/// A control chart of one quantity over the newest sixty entries: values, control limits, alarms.
std::string historyView(const std::vector<calibration::DriftEntry>& history, const calibration::DriftReview& review,
                        calibration::DriftQuantity quantity);

/// Errors against their limits.
std::string figuresTable(const calibration::RigRecord& record);
std::string outliersTable(const calibration::RigRecord& record);
/// Device, times, files, versions.
std::string originTable(const calibration::RigRecord& record, const std::string& now_utc);

}  // namespace app
