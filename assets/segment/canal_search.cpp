#include "assets/segment/canal_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "assets/segment/canal_line.h"
#include "assets/segment/cell_filters.h"
#include "assets/segment/cheapest_path.h"

namespace assets {
namespace {

using Line = std::vector<glm::dvec3>;

/// What a millimetre costs: in what looks like canal, and in a tooth; 1 in marrow, 1.5 near the surface.
struct CanalCosts {
  float half_score = 1.0F;  ///< what looks half like canal
  float least = 0.12F, in_tooth = 0.5F;
};
constexpr std::array<CanalCosts, 4> kTried{
    {{1.0F, 0.12F, 0.5F}, {1.0F, 0.25F, 1.2F}, {1.4F, 0.12F, 0.5F}, {1.4F, 0.25F, 1.2F}}};
constexpr float kNearSurface = 1.5F, kSlope = 5.0F, kLooksLikeCanal = 1.2F;
/// As bad as a millimetre off the canal: an eighth of a radian squared per millimetre.
constexpr double kBendWeight_mm = 8.0;
constexpr double kForamen_mm = 12.0, kDarkest_hu = 150.0, kMostMeanCost = 0.5, kOffBone_mm = 2.0;

std::vector<float> costOf(const HalfJaw& half, const CanalCosts& costs) {
  std::vector<float> cost(half.score.size(), 0.0F);
  for (std::size_t n = 0; n < cost.size(); ++n)
    if (half.solid[n] != 0)
      cost[n] = half.may_hold[n] != 0
                    ? costs.least + 1.0F / (1.0F + std::exp(kSlope * (half.score[n] - costs.half_score)))
                : half.tooth[n] != 0 ? costs.in_tooth
                                     : kNearSurface;
  return cost;
}

/// Millimetres off the canal, and as many for bends.
double badness(const HalfJaw& half, const Line& line) {
  double off_mm = 0.0, bend = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const glm::ivec3 at(glm::floor(half.grid.indexFromPoint(0.5 * (line[n - 1] + line[n])) + 0.5));
    const bool is_canal = half.grid.contains(at) && half.may_hold[half.grid.index(at)] != 0 &&
                          half.score[half.grid.index(at)] > kLooksLikeCanal;
    if (!is_canal) off_mm += glm::distance(line[n - 1], line[n]);
  }
  for (std::size_t n = 2; n + 2 < line.size(); ++n) {
    const glm::dvec3 before = glm::normalize(line[n] - line[n - 2]), after = glm::normalize(line[n + 2] - line[n]);
    const double turn = std::acos(std::clamp(glm::dot(before, after), -1.0, 1.0));
    bend += 0.25 * turn * turn;
  }
  return off_mm + kBendWeight_mm * bend;
}

}  // namespace

std::vector<std::size_t> canalWay(const HalfJaw& half, std::span<const std::size_t> from,
                                  std::span<const std::size_t> to) {
  std::vector<std::size_t> best;
  double least = 1e18;
  for (const CanalCosts& costs : kTried) {
    std::vector<std::size_t> way = cheapestPath(half.grid.size, costOf(half, costs), from, to);
    if (way.size() < 2) {
      if (best.empty()) best = std::move(way);
      continue;
    }
    const double bad = badness(half, centredCanal(half, pointsOfWay(half.grid, way), CanalEnds::kept));
    if (bad < least) least = bad, best = std::move(way);
  }
  return best;
}

Line quickCanal(const HalfJaw& half, std::span<const glm::dvec3> points_P_mm) {
  if (half.score.empty() || points_P_mm.size() < 2) return {};
  const std::vector<float> cost = costOf(half, kTried.front());
  std::vector<std::size_t> way;
  std::size_t before = 0;
  for (std::size_t n = 0; n < points_P_mm.size(); ++n) {
    const std::size_t here = boneNear(half, points_P_mm[n]);
    if (here == half.grid.voxelCount()) return {};
    if (n > 0) {
      const std::vector<std::size_t> next =
          cheapestPath(half.grid.size, cost, std::span(&before, 1), std::span(&here, 1));
      if (next.empty()) return {};
      way.insert(way.end(), next.begin() + (n > 1 ? 1 : 0), next.end());
    }
    before = here;
  }
  if (way.size() < 2) return {};
  return centredCanal(half, pointsOfWay(half.grid, way), CanalEnds::kept);
}

Line wayToForamen(const HalfJaw& half, const glm::dvec3& end_P_mm, Foramen foramen, bool is_right) {
  const VolumeGrid& grid = half.grid;
  const auto from = boneNear(half, end_P_mm);
  if (from == grid.voxelCount()) return {};
  // Beyond the bone, and in teeth, as bright as its rim: the foramen alone is dark there.
  std::vector<float> rim;
  for (std::size_t n = 0; n < half.solid.size(); ++n)
    if (half.solid[n] != 0 && half.may_hold[n] == 0 && half.tooth[n] == 0) rim.push_back(half.hounsfield[n]);
  if (rim.empty()) return {};
  const float rim_hu = valueAtShare(std::move(rim), 0.7);
  const int reach = static_cast<int>(std::ceil(kForamen_mm / grid.spacing_mm)) + 3;
  const glm::ivec3 at = elementAt(grid.size, from);
  const CellBox box = CellBox{at, at + 1}.grown(reach, grid.size);
  const glm::ivec3 size = box.size();
  std::vector<float> hu = croppedTo(box, grid.size, half.hounsfield);
  const CellMask solid = croppedTo(box, grid.size, half.solid), tooth = croppedTo(box, grid.size, half.tooth);
  for (std::size_t n = 0; n < hu.size(); ++n)
    if (solid[n] == 0 || tooth[n] != 0) hu[n] = rim_hu;
  constexpr double kSmooth_mm = 0.35;
  smoothCells(size, kSmooth_mm / grid.spacing_mm, hu);
  std::vector<float> cost(hu.size(), 0.0F);
  std::vector<std::size_t> surface;
  forCellsNear(glm::dvec3(at - box.low), kForamen_mm, grid.spacing_mm, size, [&](glm::ivec3 ijk, double) {
    const std::size_t n = indexIn(size, ijk);
    if (solid[n] == 0 || tooth[n] != 0) return;
    cost[n] = 0.1F + std::clamp((hu[n] - static_cast<float>(kDarkest_hu)) / (0.5F * rim_hu), 0.0F, 1.5F);
    bool is_surface = false;
    forNeighbours(size, n, [&](std::size_t other) { is_surface = is_surface || solid[other] == 0; });
    const glm::dvec3 way = grid.centre_P_mm(box.low + ijk) - end_P_mm;
    const double outwards = is_right ? -way.x : way.x;
    const bool is_there = foramen == Foramen::mental ? outwards > 1.0 : outwards < 1.0 && way.z > -1.0;
    if (is_surface && is_there) surface.push_back(n);
  });
  const std::vector<std::size_t> start{indexIn(size, at - box.low)};
  if (surface.empty() || cost[start[0]] <= 0.0F) return {};
  const std::vector<std::size_t> way = cheapestPath(size, cost, start, surface);
  double sum = 0.0;
  for (const std::size_t n : way) sum += static_cast<double>(cost[n]);
  if (way.empty() || sum > kMostMeanCost * static_cast<double>(way.size())) return {};
  return pointsOfWay({size, grid.spacing_mm, grid.centre_P_mm(box.low)}, way);
}

std::size_t boneNear(const HalfJaw& half, const glm::dvec3& p_P_mm) {
  const VolumeGrid& grid = half.grid;
  std::size_t nearest = grid.voxelCount();
  double least_mm = 2.0 * kOffBone_mm;
  forCellsNear(grid.indexFromPoint(p_P_mm), kOffBone_mm, grid.spacing_mm, grid.size,
               [&](glm::ivec3 ijk, double away_mm) {
                 if (half.solid[grid.index(ijk)] != 0 && away_mm < least_mm)
                   least_mm = away_mm, nearest = grid.index(ijk);
               });
  return nearest;
}

}  // namespace assets
