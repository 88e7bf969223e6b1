#include "haptics/bone/ball_rows.h"

#include <algorithm>
#include <cmath>

#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

// Baseline x86-64 has no rounding instruction; a cast and a compare beat the library call.
int floorOf(double x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<double>(i) > x ? 1 : 0);
}
int ceilOf(double x) {
  const int i = static_cast<int>(x);
  return i + (static_cast<double>(i) < x ? 1 : 0);
}

}  // namespace
BallRows::BallRows(const assets::VolumeGrid& grid, const calibration::Point<calibration::Patient>& centre_P,
                   double radius_mm)
    : centre(grid.indexFromPoint(centre_P.mm)), radius(radius_mm / grid.spacing_mm) {
  outer = radius + kVoxelSphereRadius;
  inner = radius - kVoxelSphereRadius;
  if (!(radius > 0.0) || !std::isfinite(radius) || !std::isfinite(glm::length(centre))) return;
  glm::ivec3 box_first{0}, box_last{-1};
  for (int axis = 0; axis < 3; ++axis) {
    // Clipped as doubles: a wild pose must not overflow an index.
    const double low = std::max(0.0, centre[axis] - outer);
    const double high = std::min(static_cast<double>(grid.size[axis] - 1), centre[axis] + outer);
    if (!(low <= high)) return;
    box_first[axis] = ceilOf(low);
    box_last[axis] = floorOf(high);
  }
  first = box_first;
  last = box_last;
}

void BallRows::rows(int j, int k, std::array<BallRow, kRowsAtOnce>& out) const {
  constexpr std::size_t kRows = kRowsAtOnce;
  const double dz = k - centre.z, low_end = first.x, high_end = last.x;
  const double outer2 = outer * outer - dz * dz, inner2 = inner > 0.0 ? inner * inner - dz * dz : -1.0;
  // Arrays and selections instead of branches, for the vectoriser.
  alignas(32) double dy[kRows], low[kRows], high[kRows], inner_low[kRows], inner_high[kRows];
  alignas(32) int outer_first[kRows], outer_last[kRows], inner_first[kRows], inner_last[kRows];
  for (std::size_t n = 0; n < kRows; ++n) {
    dy[n] = j + static_cast<int>(n) - centre.y;
    const double room = outer2 - dy[n] * dy[n], inner_room = inner2 - dy[n] * dy[n];
    const double reach = std::sqrt(room > 0.0 ? room : 0.0), half = std::sqrt(inner_room > 0.0 ? inner_room : 0.0);
    const double from = centre.x - reach, to = centre.x + reach;
    low[n] = from > low_end ? from : low_end;
    high[n] = to < high_end ? to : high_end;
    inner_low[n] = inner_room > 0.0 ? centre.x - half : high_end + 1.0;
    inner_high[n] = inner_room > 0.0 ? centre.x + half : -1.0;
  }
  for (std::size_t n = 0; n < kRows; ++n) {
    // high < low - 1 cannot happen inside the box except for rows that miss the ball: they end up empty.
    const int outer_from = ceilOf(low[n]), outer_to = floorOf(high[n]);
    const double from = inner_low[n] > low[n] ? inner_low[n] : low[n];
    const double to = inner_high[n] < high[n] ? inner_high[n] : high[n];
    const int past = outer_to + 1, inner_from = ceilOf(from), inner_to = floorOf(to);
    outer_first[n] = outer_from;
    outer_last[n] = outer_to;
    inner_first[n] = inner_from < past ? inner_from : past;
    inner_last[n] = inner_to > inner_first[n] - 1 ? inner_to : inner_first[n] - 1;
  }
  for (std::size_t n = 0; n < kRows; ++n)
    out[n] = {outer_first[n], outer_last[n], inner_first[n], inner_last[n], dy[n], dz};
}

}  // namespace haptics
