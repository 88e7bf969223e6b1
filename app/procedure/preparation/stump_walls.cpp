#include "app/procedure/preparation/stump_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace app {
namespace {

constexpr double kToBuccal_rad = 0.5 * std::numbers::pi;
/// Left out over the margin, whose inner angle is round, and the slope at which a wall ends: 45 degrees.
constexpr double kOverMargin_mm = 0.5, kWallEnds = 1.0, kLeastWall_mm = 1.0;
constexpr double kSlopeOver_mm = 0.3;  ///< window of a slope
constexpr double kPlane_mm = 1.0;      ///< window of smoothness
constexpr double kSharp_mm = 0.2;
constexpr double kNearWay_rad = std::numbers::pi / 6.0;

/// Walks inwards until it meets the tooth; then the sum of the solid says where the wall is.
double wallOf(const Crown& crown, const BoxBytes& solid, const glm::dvec3& axis_P, const glm::dvec3& way_P) {
  const double step_mm = 0.5 * solid.grid().spacing_mm, half_mm = wallReach_mm(solid.grid());
  for (double mm = crown.reach_mm + 4.0 * step_mm; mm > 0.0; mm -= step_mm) {
    const glm::dvec3 p_P = axis_P + mm * way_P;
    if (solid.nearest(p_P) < 128 || !crown.isTooth(p_P)) continue;
    return mm - half_mm + solid.solidBetween_mm(axis_P + (mm - half_mm) * way_P, way_P, 2.0 * half_mm);
  }
  return StumpWalls::kNone;
}

/// Least squares of r over the height, between two levels.
WallLine lineThrough(const StumpWalls& walls, std::size_t around, std::size_t from, std::size_t end) {
  double n = 0.0, sz = 0.0, sr = 0.0, szz = 0.0, szr = 0.0;
  const double from_mm = walls.height_mm(from);
  for (std::size_t level = from; level < end; ++level) {
    const double r = walls.radius_mm(around, level), z = walls.height_mm(level) - from_mm;
    n += 1.0, sz += z, sr += r, szz += z * z, szr += z * r;
  }
  WallLine line;
  const double spread = n * szz - sz * sz;
  if (n < 3.0 || spread <= 0.0) return line;
  const double rise = (n * szr - sz * sr) / spread;
  line.from_mm = from_mm, line.to_mm = walls.height_mm(end - 1);
  line.at_mm = (sr - rise * sz) / n, line.slope = -rise;
  line.angle_rad = std::atan(line.slope * walls.squareness(around, from));
  return line;
}

/// Up from the margin as long as the wall is steeper than 45 degrees.
WallLine wallLine(const StumpWalls& walls, std::size_t around, double margin_mm) {
  const std::size_t from = walls.levelAt(margin_mm + kOverMargin_mm);
  const auto window = static_cast<std::size_t>(std::max(1.0, std::round(kSlopeOver_mm / walls.step_mm())));
  std::size_t end = from;
  while (end + window < walls.heights()) {
    const double r = walls.radius_mm(around, end), above = walls.radius_mm(around, end + window);
    if (std::isnan(r) || std::isnan(above)) break;
    if (r - above > kWallEnds * static_cast<double>(window) * walls.step_mm()) break;
    ++end;
  }
  // The rounded edge begins within the last window.
  end = end > from + window ? end - window : from;
  if (static_cast<double>(end - from) * walls.step_mm() < kLeastWall_mm) return {};
  return lineThrough(walls, around, from, end);
}

/// Of opposite pairs whose direction from mesial is within `near_rad` of `way_rad`; all: pi / 2.
double convergence_rad(const std::array<WallLine, StumpWalls::kAround>& lines, double way_rad, double near_rad) {
  constexpr std::size_t kHalf = StumpWalls::kAround / 2;
  double sum = 0.0, pairs = 0.0;
  for (std::size_t n = 0; n < kHalf; ++n) {
    const double off = std::remainder(StumpWalls::turn_rad(n) - way_rad, std::numbers::pi);
    if (std::abs(off) > near_rad + 1e-9 || !lines[n].isThere() || !lines[n + kHalf].isThere()) continue;
    sum += lines[n].angle_rad + lines[n + kHalf].angle_rad;
    pairs += 1.0;
  }
  return pairs > 0.0 ? sum / pairs : StumpWalls::kNone;
}

/// Square of what a place of the wall stands beside the plane through its window, whose value in the middle of a
/// symmetric window is the mean; none: the window leaves the wall.
double besidePlane_mm2(const StumpWalls& walls, std::size_t around, std::size_t level, std::size_t levels) {
  const double here_mm = walls.radius_mm(around, level), arc_mm = here_mm * StumpWalls::turn_rad(1);
  const auto beside = static_cast<std::size_t>(std::max(1.0, 0.5 * kPlane_mm / std::max(arc_mm, 1e-3)));
  double count = 0.0, sum_mm = 0.0;
  for (std::size_t a = 0; a <= 2 * beside; ++a)
    for (std::size_t b = 0; b <= 2 * levels; ++b) {
      sum_mm += walls.radius_mm((around + StumpWalls::kAround + a - beside) % StumpWalls::kAround, level + b - levels);
      count += 1.0;
    }
  const double off_mm = here_mm - sum_mm / count;
  return off_mm * off_mm;
}

/// Of all walls, from their lower to their upper end.
double roughness_mm(const StumpWalls& walls, const std::array<WallLine, StumpWalls::kAround>& lines) {
  const auto levels = static_cast<std::size_t>(std::max(1.0, std::round(0.5 * kPlane_mm / walls.step_mm())));
  double sum_mm2 = 0.0, count = 0.0;
  for (std::size_t around = 0; around < StumpWalls::kAround; ++around) {
    if (!lines[around].isThere()) continue;
    const std::size_t from = walls.levelAt(lines[around].from_mm) + levels, end = walls.levelAt(lines[around].to_mm);
    for (std::size_t level = from; level + levels <= end; ++level) {
      const double mm2 = besidePlane_mm2(walls, around, level, levels);
      if (std::isnan(mm2)) continue;
      sum_mm2 += mm2;
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(sum_mm2 / count) : 0.0;
}

/// Where the profile has left the wall by 0.5 mm, or the stump ends.
double wallTop_mm(const StumpWalls& walls, std::size_t around, const WallLine& line) {
  constexpr double kLeft_mm = 0.5;
  std::size_t level = walls.levelAt(line.to_mm);
  for (; level < walls.heights(); ++level) {
    const double r = walls.radius_mm(around, level);
    if (std::isnan(r) || line.radiusAt_mm(walls.height_mm(level)) - r > kLeft_mm) break;
  }
  return walls.height_mm(level - 1) + 0.5 * walls.step_mm();
}

/// Radius of the line angle, from where the profile leans by 25 degrees to where it leans by 55: nearer to the top it
/// ends within a voxel. 0: it turns at once.
double edgeRadius_mm(const StumpWalls& walls, std::size_t around, const WallLine& line) {
  constexpr double kFrom = 0.4663, kTo = 1.4281, kHalfTurn_rad = 15.0 * std::numbers::pi / 180.0;
  double from_z = StumpWalls::kNone, from_r = 0.0;
  for (std::size_t level = walls.levelAt(line.to_mm); level + 1 < walls.heights(); ++level) {
    const double below = walls.radius_mm(around, level - 1), above = walls.radius_mm(around, level + 1);
    if (std::isnan(above)) break;
    const double lean = (below - above) / (2.0 * walls.step_mm());
    if (lean >= kFrom && std::isnan(from_z)) from_z = walls.height_mm(level), from_r = walls.radius_mm(around, level);
    if (lean >= kTo && !std::isnan(from_z)) {
      const double chord_mm = std::hypot(walls.height_mm(level) - from_z, walls.radius_mm(around, level) - from_r);
      return chord_mm / (2.0 * std::sin(kHalfTurn_rad));
    }
  }
  return 0.0;
}

}  // namespace

StumpWalls::StumpWalls(const Crown& crown, const BoxBytes& solid, double from_mm, double to_mm)
    : from_mm_(from_mm),
      step_mm_(solid.grid().spacing_mm),
      heights_(static_cast<std::size_t>(std::max(0.0, std::ceil((to_mm - from_mm) / step_mm_))) + 1),
      radius_mm_(heights_ * kAround) {
  for (std::size_t level = 0; level < heights_; ++level)
    for (std::size_t around = 0; around < kAround; ++around) {
      const double turn = turn_rad(around);
      radius_mm_[level * kAround + around] =
          wallOf(crown, solid, crown.frame.inP({0.0, 0.0, height_mm(level)}),
                 crown.frame.axes_P * glm::dvec3(std::cos(turn), std::sin(turn), 0.0));
    }
}

std::size_t StumpWalls::levelAt(double height_mm) const {
  const double level =
      std::clamp(std::round((height_mm - from_mm_) / step_mm_), 1.0, static_cast<double>(heights_ - 1));
  return static_cast<std::size_t>(level);
}

double StumpWalls::turn_rad(std::size_t around) {
  return 2.0 * std::numbers::pi * static_cast<double>(around) / kAround;
}

double StumpWalls::squareness(std::size_t around, std::size_t level) const {
  constexpr std::size_t kOver = 4;
  const double before = radius_mm((around + kAround - kOver) % kAround, level);
  const double after = radius_mm((around + kOver) % kAround, level), r = radius_mm(around, level);
  if (std::isnan(before) || std::isnan(after) || std::isnan(r)) return 1.0;
  const double lean = (after - before) / (turn_rad(2 * kOver) * r);
  return 1.0 / std::sqrt(1.0 + lean * lean);
}

WallForm wallForm(const StumpWalls& walls, const std::array<double, StumpWalls::kAround>& margin_mm) {
  WallForm form;
  double there = 0.0, height_mm = 0.0, width_mm = 0.0, sharp = 0.0;
  for (std::size_t around = 0; around < StumpWalls::kAround; ++around) {
    WallLine& line = form.lines[around];
    if (std::isnan(margin_mm[around])) continue;
    line = wallLine(walls, around, margin_mm[around]);
    if (!line.isThere()) continue;
    there += 1.0;
    height_mm += wallTop_mm(walls, around, line) - margin_mm[around];
    width_mm += 2.0 * line.radiusAt_mm(margin_mm[around]);
    if (edgeRadius_mm(walls, around, line) < kSharp_mm) sharp += 1.0;
  }
  if (there == 0.0) return form;
  form.height_mm = height_mm / there;
  form.height_over_width = height_mm / width_mm;
  form.sharp_share = sharp / there;
  form.convergence_rad = convergence_rad(form.lines, 0.0, 0.5 * std::numbers::pi);
  form.mesiodistal_rad = convergence_rad(form.lines, 0.0, kNearWay_rad);
  form.buccolingual_rad = convergence_rad(form.lines, kToBuccal_rad, kNearWay_rad);
  form.roughness_mm = roughness_mm(walls, form.lines);
  return form;
}

}  // namespace app
