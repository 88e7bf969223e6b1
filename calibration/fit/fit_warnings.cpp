#include "calibration/fit/fit_warnings.h"

#include <algorithm>

#include <fmt/format.h>

namespace calibration {
namespace {

constexpr double kEnoughOfRegion = 0.6;
constexpr double kManyOutliers = 0.1;
constexpr double kOptimistic = 2.0;  ///< predicted error at unseen tilts over the cross-validated one
constexpr double kMatters_mm = 0.3;  ///< smaller errors give no warning
constexpr double kOverFitted = 3.0;  ///< cross-validated error over that of the fitted touches

}  // namespace

std::vector<FitWarning> fitWarnings(const FitEvidence& e) {
  using Kind = FitWarning::Kind;
  std::vector<FitWarning> warnings;
  if (e.may_be_mirrored)
    warnings.push_back({Kind::mirrored,
                        "the touches fit a mirrored image better, by the stylus direction or by themselves: "
                        "check that the drawn F reads right, or that the device does stand behind the screen"});
  if (e.used < kGoodCount)
    warnings.push_back(
        {Kind::few_touches, fmt::format("{} touches are few: take {} or more, 27 for the best", e.used, kGoodCount)});
  if (!e.flat && e.hull_mm3 < kEnoughOfRegion * e.region_mm3)
    warnings.push_back(
        {Kind::small_volume, fmt::format("the touches span {:.0f} of the case's {:.0f} cm3: touch further out, "
                                         "outside of them the error grows",
                                         e.hull_mm3 / 1000.0, e.region_mm3 / 1000.0)});
  if (e.tilt_spread_deg < kMinTilt_deg)
    warnings.push_back(
        {Kind::little_tilt, fmt::format("the stylus was held much the same way ({:.0f} deg apart, at least {:.0f} "
                                        "are needed): tilt it differently at each touch",
                                        e.tilt_spread_deg, kMinTilt_deg)});
  if (e.unseen_tilts_rms_mm > std::max(kMatters_mm, kOptimistic * e.cv_rms_mm))
    warnings.push_back(
        {Kind::optimistic_check,
         fmt::format("the cross-validated {:.2f} mm hold for these ways of holding the stylus alone, {:.1f} mm are "
                     "possible for others: touch with other tilts, or verify with them",
                     e.cv_rms_mm, e.unseen_tilts_rms_mm)});
  if (e.outliers > kManyOutliers * (e.used + e.outliers))
    warnings.push_back({Kind::many_outliers,
                        fmt::format("{} of {} touches fit no common arm: check that the jig is fixed and the order of "
                                    "the targets kept",
                                    e.outliers, e.used + e.outliers)});
  if (e.cv_rms_mm > std::max(kMatters_mm, kOverFitted * e.fre_rms_mm))
    warnings.push_back(
        {Kind::over_fitted, fmt::format("{:.2f} mm at the fitted touches are not reliable: held-out touches were off "
                                        "by {:.2f} mm; take more touches",
                                        e.fre_rms_mm, e.cv_rms_mm)});
  return warnings;
}

}  // namespace calibration
