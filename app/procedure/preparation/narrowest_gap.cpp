#include "app/procedure/preparation/narrowest_gap.h"

#include <cmath>

namespace app {
namespace {

constexpr int kReach = 4;           ///< cells around: 0.2 mm
constexpr double kRound_mm = 5e-4;  ///< that a place may lie off the round form

/// c + bx x + by y + axx x² + axy x y + ayy y², in cells.
struct RoundForm {
  double c, bx, by, axx, axy, ayy;
  double at(double x, double y) const { return c + bx * x + by * y + axx * x * x + axy * x * y + ayy * y * y; }
};

/// Of gaps over the square around a place. On a square raster the sums of the least squares are known.
RoundForm roundForm(const OcclusalRaster& gap_mm, int x, int y) {
  constexpr int kSide = 2 * kReach + 1;
  constexpr double kPlaces = kSide * kSide;
  double squares = 0.0, fourths = 0.0;
  for (int i = -kReach; i <= kReach; ++i) squares += i * i, fourths += i * i * i * i;
  const double s2 = kSide * squares, s4 = kSide * fourths, s22 = squares * squares;
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0, sum_yy = 0.0;
  for (int j = -kReach; j <= kReach; ++j)
    for (int i = -kReach; i <= kReach; ++i) {
      const auto g = static_cast<double>(gap_mm.at(x + i, y + j));
      sum += g, sum_x += i * g, sum_y += j * g, sum_xx += i * i * g, sum_xy += i * j * g, sum_yy += j * j * g;
    }
  // kPlaces c + s2 (a + b) = sum; s2 c + s4 a + s22 b = sum_xx; s2 c + s22 a + s4 b = sum_yy.
  const double both = (sum_xx + sum_yy - 2.0 * s2 * sum / kPlaces) / (s4 + s22 - 2.0 * s2 * s2 / kPlaces);
  const double apart = (sum_xx - sum_yy) / (s4 - s22);
  return {(sum - s2 * both) / kPlaces, sum_x / s2,   sum_y / s2,
          0.5 * (both + apart),        sum_xy / s22, 0.5 * (both - apart)};
}

}  // namespace

NarrowestGap narrowestGap(const OcclusalRaster& gap_mm) {
  NarrowestGap least;
  glm::ivec2 at(0);
  for (int y = 0; y < OcclusalRaster::kSide; ++y)
    for (int x = 0; x < OcclusalRaster::kSide; ++x)
      if (static_cast<double>(gap_mm.at(x, y)) < least.gap_mm)
        least.gap_mm = static_cast<double>(gap_mm.at(x, y)), at = {x, y};
  if (!std::isfinite(least.gap_mm)) return least;
  least.place_mm = OcclusalRaster::place_mm(at.x, at.y);
  const glm::ivec2 end(OcclusalRaster::kSide - kReach);
  if (at.x < kReach || at.y < kReach || at.x >= end.x || at.y >= end.y) return least;
  const RoundForm form = roundForm(gap_mm, at.x, at.y);
  const double curved = 4.0 * form.axx * form.ayy - form.axy * form.axy;
  // A comparison with no number fails.
  if (!(curved > 0.0) || !(form.axx > 0.0)) return least;
  const glm::dvec2 top((form.axy * form.by - 2.0 * form.ayy * form.bx) / curved,
                       (form.axy * form.bx - 2.0 * form.axx * form.by) / curved);
  if (glm::length(top) > 1.5) return least;
  for (int j = -kReach; j <= kReach; ++j)
    for (int i = -kReach; i <= kReach; ++i)
      if (std::abs(static_cast<double>(gap_mm.at(at.x + i, at.y + j)) - form.at(i, j)) > kRound_mm) return least;
  return {least.place_mm + OcclusalRaster::kStep_mm * top, form.at(top.x, top.y)};
}

}  // namespace app
