#include "assets/import/canal_bridge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "assets/tissue.h"

namespace assets {
namespace {

constexpr int kSides = 8, kRelaxations = 150;
constexpr double kAside_mm = 4.0;  ///< where a way begins before it is let go, beyond any root
/// Of the canal's radius: where a tooth comes nearer to what is labelled than this, its label covers the canal itself
/// and says nothing of a way round. From one jaw, whose truth runs straight on (0.51 of the radius).
constexpr double kLeastRoom = 0.6;

using Points = std::vector<glm::dvec3>;

bool isTooth(std::uint8_t label) {
  const Tissue tissue{label};
  return tissue == Tissue::other_teeth || tissue == Tissue::enamel || tissue == Tissue::dentine ||
         tissue == Tissue::pulp;
}

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

/// A stretch of the line to be laid anew, end one past its last point.
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
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& q : tooth) least = std::min(least, glm::distance(p, q));
  return least;
}

/// Out of reach of the nearest point of a tooth.
void keepOff(glm::dvec3& p, const Points& tooth, double clearance_mm) {
  const glm::dvec3* nearest = nullptr;
  double least = clearance_mm * clearance_mm;
  for (const glm::dvec3& q : tooth) {
    const glm::dvec3 apart = p - q;
    if (const double squared = glm::dot(apart, apart); squared < least) least = squared, nearest = &q;
  }
  if (nearest && least > 0.0) p = *nearest + clearance_mm / std::sqrt(least) * (p - *nearest);
}

/// Towards the least bending between what stays on either side.
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

void layAnew(Points& line, const Gap& gap, double radius_mm, const VolumeGrid& grid,
             const std::vector<std::uint8_t>& label) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t p = gap.begin - 1; p <= gap.end; ++p) low = glm::min(low, line[p]), high = glm::max(high, line[p]);
  // From the centre of a voxel at the surface to the wall is half a voxel more. Where the tooth lies nearer than that
  // to what is labelled at the gap's ends, it has taken some of the canal: no more room than there.
  const double free_mm = radius_mm + 0.5 * grid.spacing_mm, reach_mm = kAside_mm + free_mm;
  const Points tooth = toothSurface(grid, label, low - reach_mm, high + reach_mm);
  const double clearance_mm =
      std::min({free_mm, distanceTo(tooth, line[gap.begin - 1]), distanceTo(tooth, line[gap.end])});
  if (tooth.empty() || clearance_mm < kLeastRoom * radius_mm) return;

  // First as if nothing stood there.
  relax(line, gap, {}, 0.0);
  Points touched = line;
  for (std::size_t p = gap.begin; p < gap.end; ++p) keepOff(touched[p], tooth, clearance_mm);
  if (touched == line) return;

  const glm::dvec3 along = glm::normalize(line[gap.end] - line[gap.begin - 1]);
  const glm::dvec3 u =
      glm::normalize(glm::cross(along, std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 v = glm::cross(along, u);
  Points best = touched;
  double least = std::numeric_limits<double>::infinity();
  for (int side = 0; side < kSides; ++side) {
    const double turn = 2.0 * std::numbers::pi * side / kSides;
    Points way = line;
    for (std::size_t p = gap.begin; p < gap.end; ++p) {
      const double share = static_cast<double>(p + 1 - gap.begin) / static_cast<double>(gap.end + 1 - gap.begin);
      way[p] += kAside_mm * std::sin(std::numbers::pi * share) * (std::cos(turn) * u + std::sin(turn) * v);
    }
    relax(way, gap, tooth, clearance_mm);
    const double bending = bendingOf(way, gap);
    if (bending < least) least = bending, best = way;
  }
  line = best;
}

}  // namespace

void routeAroundTeeth(std::vector<glm::dvec3>& line_P_mm, const std::vector<bool>& is_bridge, double radius_mm,
                      const VolumeGrid& grid, const std::vector<std::uint8_t>& label) {
  for (const Gap& gap : gapsOf(is_bridge)) layAnew(line_P_mm, gap, radius_mm, grid, label);
}

}  // namespace assets
