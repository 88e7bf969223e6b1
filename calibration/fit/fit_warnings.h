// Warnings that a fit is less good than it seems, with what to do. Plain data; any thread. Limits:
// reference/calibration 2.4, 4.1, 4.2, 6.3.
#pragma once

#include <string>
#include <vector>

namespace calibration {

struct FitWarning {
  enum class Kind {
    few_touches,
    small_volume,
    little_tilt,
    optimistic_check,
    many_outliers,
    mirrored,
    over_fitted,
    narrow_view  ///< camera positions too near to each other
  };
  Kind kind;
  std::string line;  ///< for people: what, and what to do
};

/// Below these the full model is not selected automatically, or a warning is given.
inline constexpr int kMinForFullModel = 8, kGoodCount = 16;
inline constexpr double kMinTilt_deg = 25.0;

struct FitEvidence {
  int used = 0, outliers = 0;
  double tilt_spread_deg = 0.0;
  double hull_mm3 = 0.0, region_mm3 = 0.0;  ///< region 0: not known
  bool flat = false;                        ///< targets in a plane: no volume to compare
  bool may_be_mirrored = false;
  double fre_rms_mm = 0.0, cv_rms_mm = 0.0;
  double unseen_tilts_rms_mm = 0.0;  ///< predicted for stylus tilts that were not used
};
std::vector<FitWarning> fitWarnings(const FitEvidence& evidence);

}  // namespace calibration
