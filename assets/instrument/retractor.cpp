#include "assets/instrument/retractor.h"

#include <algorithm>
#include <cmath>

#include "assets/mesh/catmull_rom.h"
#include "assets/mesh/closed_sweep.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;
using glm::dvec2;
using glm::dvec3;

// Centre line from the tip of the blade to the end of the handle, in the plane x = 0, and half the width.
struct Bend {
  dvec2 yz_mm;
  double half_width_mm;
};
constexpr Bend kCourse[] = {{{0, 0}, 5.5},   {{5, -1}, 6.5},   {{12, 2}, 7.0},   {{20, 8}, 7.0},
                            {{27, 15}, 6.6}, {{31, 24}, 6.2},  {{32, 36}, 6.0},  {{31, 55}, 6.6},
                            {{30, 80}, 7.2}, {{30, 105}, 7.2}, {{32, 125}, 6.8}, {{37, 138}, 6.0}};
constexpr double kHalfThickness_mm = 0.5 * kRetractorThickness_mm;
constexpr double kDish_mm = 0.5;  ///< height of the edges above the middle
constexpr int kPerSpan = 12, kAtEdge = 6, kAcross = 8;

struct Station {
  dvec2 yz_mm;
  double half_width_mm, from_tip_mm;
};

std::vector<Station> stations() {
  std::vector<Station> all;
  for (std::size_t span = 0; span + 1 < std::size(kCourse); ++span)
    for (int n = span == 0 ? 0 : 1; n <= kPerSpan; ++n) {
      const double t = static_cast<double>(n) / kPerSpan;
      const dvec2 yz_mm = catmullRomAt(kCourse, span, t, &Bend::yz_mm);
      const double from_tip_mm = all.empty() ? 0.0 : all.back().from_tip_mm + glm::distance(yz_mm, all.back().yz_mm);
      all.push_back({yz_mm, catmullRomAt(kCourse, span, t, &Bend::half_width_mm), from_tip_mm});
    }
  return all;
}

/// The station `mm` from the tip, interpolated.
Station at(const std::vector<Station>& all, double mm) {
  const auto next = std::ranges::lower_bound(all, mm, {}, &Station::from_tip_mm);
  if (next == all.begin()) return all.front();
  if (next == all.end()) return all.back();
  const Station &a = *(next - 1), &b = *next;
  const double share = (mm - a.from_tip_mm) / (b.from_tip_mm - a.from_tip_mm);
  return {glm::mix(a.yz_mm, b.yz_mm, share), glm::mix(a.half_width_mm, b.half_width_mm, share), mm};
}

/// Flat, slightly dished section with semicircular edges, which begin at `half_mm`.
Ring section(const dvec3& centre_mm, const dvec3& along, double half_mm, double radius_mm, double dish_mm) {
  const dvec3 across(1, 0, 0), up = glm::cross(along, across);
  Ring ring;
  const auto add = [&](double x, double y) {
    const double share = half_mm > 0.0 ? std::clamp(x / half_mm, -1.0, 1.0) : 0.0;
    ring.push_back(centre_mm + x * across + (y + dish_mm * share * share) * up);
  };
  for (const double side : {1.0, -1.0}) {
    for (int n = 0; n <= kAtEdge; ++n) {
      const double turn = kPi * (static_cast<double>(n) / kAtEdge - 0.5);
      add(side * (half_mm + radius_mm * std::cos(turn)), side * radius_mm * std::sin(turn));
    }
    for (int n = 1; n < kAcross; ++n) add(side * half_mm * (1.0 - 2.0 * n / kAcross), side * radius_mm);
  }
  return ring;
}

}  // namespace

MeshModel retractor() {
  const std::vector<Station> course = stations();
  const double length_mm = course.back().from_tip_mm, r = kHalfThickness_mm;

  // Ring positions, denser at the round ends.
  std::vector<double> positions_mm;
  for (int n = 0; n <= 8; ++n) positions_mm.push_back(r * (1.0 - std::cos(0.5 * kPi * (n + 0.3) / 8.3)));
  for (int n = 1; n <= 14; ++n) positions_mm.push_back(r + 7.0 * std::pow(n / 14.0, 2.0));
  for (double mm = 8.6; mm < 0.5 * length_mm; mm += 1.0) positions_mm.push_back(mm);
  const std::size_t half = positions_mm.size();
  for (std::size_t n = half; n-- > 0;) positions_mm.push_back(length_mm - positions_mm[n]);

  std::vector<Ring> rings;
  for (const double mm : positions_mm) {
    const Station here = at(course, mm);
    const dvec2 along = glm::normalize(at(course, mm + 0.2).yz_mm - at(course, mm - 0.2).yz_mm);
    // Ends rounded in plan and in thickness.
    const double from_end_mm = std::min(mm, length_mm - mm);
    const double flat_mm = here.half_width_mm - r;
    const double open = std::clamp(from_end_mm / flat_mm, 0.0, 1.0);
    const double closing = std::sqrt(open * (2.0 - open));
    const double thin = std::clamp(from_end_mm / r, 0.0, 1.0);
    rings.push_back(section({0.0, here.yz_mm}, {0.0, along}, flat_mm * closing, r * std::sqrt(thin * (2.0 - thin)),
                            kDish_mm * closing * closing));
  }
  MeshPart part = closedSweep(rings);
  part.name = "Retractor";
  part.material = {{0.60f, 0.61f, 0.63f, 1.0f}, 0.34f, 1.0f};
  return {{part}};
}

}  // namespace assets
