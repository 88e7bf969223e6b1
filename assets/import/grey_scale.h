// From the grey values of a scanner to Hounsfield. Cone-beam scanners differ for one and the same tissue, and many
// store no scale, so the histogram is judged: Hounsfield as they stand; Hounsfield stored 1000 or 1024 higher; or a
// line through the peaks of air (-1000 HU) and soft tissue (40 HU). Where none of these fits there is no scale, and the
// owner is asked. Constant fill outside the scanner's field of view is left out of the histogram. Peaks: 400 bins of
// every 27th value between the 0.05 and 99.95 percentiles, smoothed by 4 bins, prominence above 0.15. Pure; any thread;
// 0.3 s for 512^3.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assets/scan_origin.h"

namespace assets {

struct GreyMap {
  GreyScale scale = GreyScale::hounsfield;
  double slope = 1.0, offset_hu = 0.0;  ///< HU = slope * grey + offset
};

/// A peak of a histogram.
struct GreyPeak {
  double grey = 0.0;
  double height = 0.0;
};

struct GreyJudgement {
  std::optional<GreyMap> map;   ///< none: no known scale
  std::vector<GreyPeak> peaks;  ///< from dark to bright
};

/// `no_value`: of voxels without one.
GreyJudgement judgeGreyScale(std::span<const std::int16_t> grey, std::int16_t no_value);

/// From the grey values of air, muscle and the dentine of a crown (-1000, 50 and 1650 HU), as a person reads them off.
/// None unless they rise.
std::optional<GreyMap> greyMapFromTissues(const std::array<double, 3>& air_muscle_dentine);

/// In place; values without one stay. Rounded, within the type.
void applyGreyMap(const GreyMap& map, std::int16_t no_value, std::span<std::int16_t> grey);

}  // namespace assets
