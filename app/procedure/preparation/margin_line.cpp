#include "app/procedure/preparation/margin_line.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr double kTouched_mm = 0.05, kShelf_mm = 0.3;

}  // namespace

std::array<double, StumpWalls::kAround> marginHeights_mm(const StumpWalls& before, const StumpWalls& after) {
  std::array<double, StumpWalls::kAround> heights_mm{};
  for (std::size_t around = 0; around < StumpWalls::kAround; ++around) {
    heights_mm[around] = StumpWalls::kNone;
    // From the top down to the highest place that is as it was; a stump that is untouched to its top has no margin.
    for (std::size_t level = after.heights(); level-- > 0;) {
      const double was = before.radius_mm(around, level), is = after.radius_mm(around, level);
      if (std::isnan(was)) continue;
      if (!std::isnan(is) && was - is <= kTouched_mm) {
        const bool is_cut_above = level + 1 < after.heights() && !std::isnan(before.radius_mm(around, level + 1));
        if (is_cut_above) heights_mm[around] = after.height_mm(level) + 0.5 * after.step_mm();
        break;
      }
    }
  }
  return heights_mm;
}

MarginLine marginLine(const StumpWalls& before, const std::array<double, StumpWalls::kAround>& heights_mm,
                      const WallForm& form, double wanted_height_mm) {
  MarginLine line;
  line.height_mm = heights_mm;
  double there = 0.0, sum = 0.0, squares = 0.0, missing = 0.0, heights = 0.0, lines = 0.0;
  line.least_mm = StumpWalls::kNone, line.most_mm = StumpWalls::kNone;
  for (std::size_t around = 0; around < StumpWalls::kAround; ++around) {
    line.width_mm[around] = StumpWalls::kNone;
    const double height_mm = heights_mm[around];
    if (std::isnan(height_mm)) {
      missing += 1.0;
      continue;
    }
    lines += 1.0;
    heights += height_mm;
    if (!form.lines[around].isThere()) {
      missing += 1.0;
      continue;
    }
    const std::size_t level = before.levelAt(height_mm);
    const double out_mm = before.radius_mm(around, level);
    const double width_mm = before.squareness(around, level) * (out_mm - form.lines[around].radiusAt_mm(height_mm));
    line.width_mm[around] = width_mm;
    if (width_mm < kShelf_mm) missing += 1.0;
    there += 1.0, sum += width_mm, squares += width_mm * width_mm;
    line.least_mm = std::fmin(line.least_mm, width_mm), line.most_mm = std::fmax(line.most_mm, width_mm);
  }
  line.missing_share = missing / StumpWalls::kAround;
  if (lines > 0.0) line.off_height_mm = heights / lines - wanted_height_mm;
  if (there == 0.0) return line;
  line.mean_mm = sum / there;
  line.waviness_mm = std::sqrt(std::max(0.0, squares / there - line.mean_mm * line.mean_mm));
  return line;
}

}  // namespace app
