// What makes a fitted arm less than it seems, said so that a technician knows what to do. Plain; any thread.
// Limits: reference/calibration 2.4, 4.1, 4.2, 6.3.
#pragma once

#include <string>
#include <vector>

namespace calibration {

/// Something that makes the result less than it seems.
struct FitWarning {
  enum class Kind {
    few_touches,
    small_volume,
    little_tilt,
    optimistic_check,
    many_outliers,
    mirrored,
    over_fitted,
    narrow_view  ///< of a camera: its positions are too near each other
  };
  Kind kind;
  std::string line;  ///< for people: what, and what to do
};

/// Below these a full model is not chosen by itself, or the technician is told.
inline constexpr int kMinForFullModel = 8, kGoodCount = 16;
inline constexpr double kMinTilt_deg = 25.0;

struct FitEvidence {
  int used = 0, outliers = 0;
  double tilt_spread_deg = 0.0;
  double hull_mm3 = 0.0, region_mm3 = 0.0;  ///< region 0: not known
  bool flat = false;                        ///< the targets lie in a plane: no volume to compare
  bool may_be_mirrored = false;
  double fre_rms_mm = 0.0, cv_rms_mm = 0.0;
  double unseen_tilts_rms_mm = 0.0;  ///< foretold for touches whose stylus is held as it never was
};
std::vector<FitWarning> fitWarnings(const FitEvidence& evidence);

}  // namespace calibration
