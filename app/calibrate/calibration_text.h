// Results of a calibration as text for the technician and as JSON. mm; directions as the surgeon sees them. Pure; any
// thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/fit/arm_fit.h"
#include "calibration/fit/pivot.h"
#include "calibration/fit/rezero.h"
#include "calibration/record/rig_record.h"
#include "calibration/verification/verdict.h"
#include "calibration/webcam/intrinsics.h"
#include "calibration/webcam/webcam_fit.h"

namespace app {

/// Compared models, outliers, warnings, the largest error.
std::string fitText(const calibration::ArmFit& fit);
std::string fitJson(const calibration::ArmFit& fit);
std::string webcamFitText(const calibration::WebcamFit& fit);
std::string webcamFitJson(const calibration::WebcamFit& fit);

/// One line: verdict, errors, the deciding limit.
std::string verificationText(const calibration::TargetErrors& errors, const calibration::Assessment& assessment);
/// {"n","tre_mean_mm","tre_rms_mm","tre_p95_mm","tre_max_mm","bias_mm","verdict"}
std::string verificationJson(const calibration::TargetErrors& errors, const calibration::Assessment& assessment);

std::string rezeroText(const calibration::Rezero& rezero);

/// `before_H_mm`: the previous tip.
std::string pivotText(const calibration::Pivot& pivot, const glm::dvec3& before_H_mm);
/// {"tip_H_mm","rms_mm","sigma_mm","tilt_spread_deg"}
std::string pivotJson(const calibration::Pivot& pivot);

inline constexpr double kGoodLens_px = 0.3, kFairLens_px = 0.6;  ///< root mean square; reference/calibration 3.3

calibration::Verdict lensVerdict(const calibration::Intrinsics& lens);

/// `refused`: images without a usable board, a line each.
std::string lensText(const calibration::Intrinsics& lens, const std::vector<std::string>& refused);
/// {"size_px","focal_px","centre_px","distortion","rms_px","views","left_out","covered_share","most_slant_deg","verdict"}
std::string lensJson(const calibration::Intrinsics& lens, const std::vector<std::string>& refused);

/// A line of the store's list: time, method, error.
std::string recordLine(const calibration::RigRecord& record);

}  // namespace app
