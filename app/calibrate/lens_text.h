// What was found of a camera's lens, in words for the technician and as JSON for programs. px. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/verification/verdict.h"
#include "calibration/webcam/intrinsics.h"

namespace app {

inline constexpr double kGoodLens_px = 0.3, kFairLens_px = 0.6;  ///< root mean square; reference/calibration 3.3

calibration::Verdict verdictOfLens(const calibration::Intrinsics& lens);

/// `refused`: pictures in which no board could be used, a line each.
std::string lensText(const calibration::Intrinsics& lens, const std::vector<std::string>& refused);
/// {"size_px","focal_px","centre_px","distortion","rms_px","views","left_out","covered_share","most_slant_deg","verdict"}
std::string lensJson(const calibration::Intrinsics& lens, const std::vector<std::string>& refused);

}  // namespace app
