#include "assets/import/canal_bridge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "assets/tissue.h"

namespace assets {
namespace {

constexpr int kSides = 8, kRelaxations = 150;
constexpr double kAside_mm = 4.0;  ///< initial deflection of a path, more than a root
/// Fraction of the canal's radius: where a tooth is nearer to the labelled canal, its label covers the canal itself and
/// the gap stays straight. From one jaw with a straight canal (0.51).
constexpr double kMinClearance = 0.6;

using Points = std::vector<glm::dvec3>;

/// Centres of the teeth's outermost voxels in a box.
Points toothSurface(const VolumeGrid& grid, const std::vector<std::uint8_t>& label, const glm::dvec3& low_P_mm,
                    const glm::dvec3& high_P_mm) {
  const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(grid.indexFromPoint(low_P_mm))), glm::ivec3(0), grid.size);
  const glm::ivec3 end =
      glm::clamp(glm::ivec3(glm::ceil(grid.indexFromPoint(high_P_mm))) + 1, glm::ivec3(0), grid.size);
  const auto is_tooth = [&](glm::ivec3 p) { return grid.contains(p) && isTooth(label[grid.index(p)]); };
  Points surface;
  forVoxels(low, end, [&](glm::ivec3 p) {
    if (!is_tooth(p)) return;
    bool is_inner = true;
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 step(0);
      step[axis] = 1;
      is_inner &= is_tooth(p + step) && is_tooth(p - step);
    }
    if (!is_inner) surface.push_back(grid.centre_P_mm(p));
  });
  return surface;
}

/// Points of the line to move, [begin, end).
struct Gap {
  std::size_t begin, end;
};

std::vector<Gap> gapsOf(const std::vector<bool>& is_bridge) {
  std::vector<Gap> gaps;
  for (std::size_t p = 2; p + 2 < is_bridge.size(); ++p) {
    if (!is_bridge[p]) continue;
    if (gaps.empty() || gaps.back().end != p) gaps.push_back({p, p});
    gaps.back().end = p + 1;
  }
  return gaps;
}

double distanceTo(const Points& tooth, const glm::dvec3& p) {
  double min_mm = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& q : tooth) min_mm = std::min(min_mm, glm::distance(p, q));
  return min_mm;
}

/// Moves p out to the clearance from the nearest point of the tooth.
void keepOff(glm::dvec3& p, const Points& tooth, double clearance_mm) {
  const glm::dvec3* nearest = nullptr;
  double least = clearance_mm * clearance_mm;
  for (const glm::dvec3& q : tooth) {
    const glm::dvec3 apart = p - q;
    if (const double squared = glm::dot(apart, apart); squared < least) least = squared, nearest = &q;
  }
  if (nearest && least > 0.0) p = *nearest + clearance_mm / std::sqrt(least) * (p - *nearest);
}

/// Relaxes the gap towards least bending, its neighbours fixed.
void relax(Points& line, const Gap& gap, const Points& tooth, double clearance_mm) {
  for (int pass = 0; pass < kRelaxations; ++pass)
    for (std::size_t p = gap.begin; p < gap.end; ++p) {
      line[p] = (4.0 * (line[p - 1] + line[p + 1]) - line[p - 2] - line[p + 2]) / 6.0;
      keepOff(line[p], tooth, clearance_mm);
    }
}

double bendingOf(const Points& line, const Gap& gap) {
  double sum = 0.0;
  for (std::size_t p = gap.begin - 1; p <= gap.end; ++p) {
    const glm::dvec3 bend = line[p - 1] - 2.0 * line[p] + line[p + 1];
    sum += glm::dot(bend, bend);
  }
  return sum;
}

void bridge(Points& line, const Gap& gap, double radius_mm, const VolumeGrid& grid,
            const std::vector<std::uint8_t>& label) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t p = gap.begin - 1; p <= gap.end; ++p) low = glm::min(low, line[p]), high = glm::max(high, line[p]);
  // Surface voxels' centres lie half a voxel inside. A tooth nearer to the labelled ends of the gap than that covers
  // part of the canal: the clearance is no larger than there.
  const double free_mm = radius_mm + 0.5 * grid.spacing_mm, reach_mm = kAside_mm + free_mm;
  const Points tooth = toothSurface(grid, label, low - reach_mm, high + reach_mm);
  const double clearance_mm =
      std::min({free_mm, distanceTo(tooth, line[gap.begin - 1]), distanceTo(tooth, line[gap.end])});
  if (tooth.empty() || clearance_mm < kMinClearance * radius_mm) return;

  // First without the tooth.
  relax(line, gap, {}, 0.0);
  Points touched = line;
  for (std::size_t p = gap.begin; p < gap.end; ++p) keepOff(touched[p], tooth, clearance_mm);
  if (touched == line) return;

  const glm::dvec3 along = glm::normalize(line[gap.end] - line[gap.begin - 1]);
  const glm::dvec3 u =
      glm::normalize(glm::cross(along, std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 v = glm::cross(along, u);
  Points best = touched;
  double least_bending = std::numeric_limits<double>::infinity();
  for (int side = 0; side < kSides; ++side) {
    const double turn = 2.0 * std::numbers::pi * side / kSides;
    Points way = line;
    for (std::size_t p = gap.begin; p < gap.end; ++p) {
      const double share = static_cast<double>(p + 1 - gap.begin) / static_cast<double>(gap.end + 1 - gap.begin);
      way[p] += kAside_mm * std::sin(std::numbers::pi * share) * (std::cos(turn) * u + std::sin(turn) * v);
    }
    relax(way, gap, tooth, clearance_mm);
    const double bending = bendingOf(way, gap);
    if (bending < least_bending) least_bending = bending, best = way;
  }
  line = best;
}

}  // namespace

void routeAroundTeeth(std::vector<glm::dvec3>& line_P_mm, const std::vector<bool>& is_bridge, double radius_mm,
                      const VolumeGrid& grid, const std::vector<std::uint8_t>& label) {
  for (const Gap& gap : gapsOf(is_bridge)) bridge(line_P_mm, gap, radius_mm, grid, label);
}

}  // namespace assets
