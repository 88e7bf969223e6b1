#include "assets/segment/canal_path.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "assets/load_error.h"
#include "assets/segment/canal_line.h"
#include "assets/segment/canal_search.h"

namespace assets {
namespace {

constexpr double kEndSlab_mm = 2.5, kRamusOverBite_mm = 2.0, kBehindShare = 0.75, kFrontShare = 0.38,
                 kPremolar_mm = 3.5, kBodyShare = 0.62;
constexpr std::size_t kEndCells = 60;
constexpr double kAroundClicks_mm = 8.0;

using Line = std::vector<glm::dvec3>;

/// The cells of a set that look most like canal.
template <class Belongs>
std::vector<std::size_t> bestCells(const HalfJaw& half, const Belongs& belongs) {
  std::vector<std::size_t> cells;
  forVoxels(half.grid, [&](glm::ivec3 ijk, std::size_t n) {
    if (half.may_hold[n] != 0 && belongs(ijk)) cells.push_back(n);
  });
  std::ranges::stable_sort(cells, std::greater<>(), [&](std::size_t n) { return half.score[n]; });
  cells.resize(std::min(cells.size(), kEndCells));
  return cells;
}

/// The mental foramen lies below the premolars; y, if one of them is numbered.
std::optional<double> frontEnd_P_mm(const std::vector<FoundTooth>& teeth, bool is_right) {
  double sum = 0.0, count = 0.0;
  for (const FoundTooth& tooth : teeth) {
    if (tooth.fdi / 10 != (is_right ? 4 : 3) || (tooth.fdi % 10 != 4 && tooth.fdi % 10 != 5)) continue;
    sum += tooth.centre_P_mm.y + (tooth.fdi % 10 == 4 ? kPremolar_mm : -kPremolar_mm);
    count += 1.0;
  }
  return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

/// What is known of where a canal ends, in cells.
struct EndPlaces {
  double bite_k = 0.0;              ///< height of the bite
  double bite_slope = 0.0;          ///< of the bite towards the back
  double bite_j = 0.0;              ///< where it has the height bite_k
  std::optional<double> front_j{};  ///< of the mental foramen
};

/// From the body to the ramus; none without both.
std::vector<std::size_t> pathThrough(const HalfJaw& half, const EndPlaces& ends) {
  const double spacing_mm = half.grid.spacing_mm;
  glm::ivec3 low(half.grid.size), high(0);
  int last_tooth = 0;
  std::vector<int> tooth_rows;
  forVoxels(half.grid, [&](glm::ivec3 ijk, std::size_t n) {
    if (half.tooth[n] != 0) tooth_rows.push_back(ijk.y);
    if (half.may_hold[n] == 0) return;
    low = glm::min(low, ijk), high = glm::max(high, ijk);
  });
  if (!tooth_rows.empty()) {
    const auto at = tooth_rows.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(tooth_rows.size() - 1));
    std::ranges::nth_element(tooth_rows, at);
    last_tooth = *at;
  }
  const double behind = high.y - (high.y - last_tooth) * kBehindShare, slab = kEndSlab_mm / spacing_mm;
  const auto ramus_height = [&](int j) {
    const double bite = ends.bite_k + ends.bite_slope * (j - ends.bite_j);
    return std::min(bite + kRamusOverBite_mm / spacing_mm, high.z - 3.0);
  };
  const double front = ends.front_j.value_or(low.y + (last_tooth - low.y) * kFrontShare),
               body_k = low.z + (ends.bite_k - low.z) * kBodyShare;
  const auto ramus =
      bestCells(half, [&](glm::ivec3 p) { return p.y > behind && std::abs(p.z - ramus_height(p.y)) < slab; });
  const auto body = bestCells(half, [&](glm::ivec3 p) { return std::abs(p.y - front) < slab && p.z < body_k; });
  if (ramus.empty() || body.empty()) return {};

  return canalWay(half, body, ramus);
}

/// The jaw's voxels around points.
CellBox boxAround(const VolumeGrid& grid, const Line& points_P_mm, double margin_mm) {
  glm::dvec3 low_P_mm = points_P_mm.front(), high_P_mm = points_P_mm.front();
  for (const glm::dvec3& p : points_P_mm) low_P_mm = glm::min(low_P_mm, p), high_P_mm = glm::max(high_P_mm, p);
  const glm::dvec3 far = glm::dvec3(grid.size) + 1e3;
  const auto cell_at = [&](const glm::dvec3& p_P_mm) {
    return glm::ivec3(glm::clamp(glm::floor(grid.indexFromPoint(p_P_mm)), -far, far));
  };
  return CellBox{cell_at(low_P_mm - margin_mm), cell_at(high_P_mm + margin_mm) + 2}.grown(0, grid.size);
}

/// Found in cells, with both foramina, and centred in voxels.
std::optional<CanalProposal> proposedCanal(const CanalScene& scene, const std::vector<FoundTooth>& teeth,
                                           bool is_right) {
  const HalfJaw half = halfIn(scene, boxOfHalf(scene, is_right), coarseEdge(scene.jaw.grid));
  if (half.score.empty()) return std::nullopt;
  const VolumeGrid& grid = half.grid;
  const double middle_P_mm = scene.arch.centre_P_mm.y - 20.0;
  EndPlaces ends{(scene.sheet.planeHeight_P_mm(scene.arch, middle_P_mm) - grid.origin_P_mm.z) / grid.spacing_mm,
                 scene.sheet.slope, (middle_P_mm - grid.origin_P_mm.y) / grid.spacing_mm,
                 frontEnd_P_mm(teeth, is_right)};
  if (ends.front_j) ends.front_j = (*ends.front_j - grid.origin_P_mm.y) / grid.spacing_mm;
  const Line found = pointsOfWay(grid, pathThrough(half, ends));
  if (found.size() < 2) return std::nullopt;
  Line way = wayToForamen(half, found.front(), Foramen::mental, is_right);
  std::ranges::reverse(way);
  way.insert(way.end(), found.begin(), found.end());
  const Line behind = wayToForamen(half, found.back(), Foramen::mandibular, is_right);
  way.insert(way.end(), behind.begin(), behind.end());
  constexpr double kAround_mm = 4.0;
  const HalfJaw fine = boneIn(scene, boxAround(scene.jaw.grid, way, kAround_mm), 1);
  CanalProposal canal;
  canal.is_right = is_right;
  canal.line_P_mm = centredCanal(fine.smooth_hu.empty() ? half : fine, way, CanalEnds::kept);
  return wayLength_mm(canal.line_P_mm) >= kLeastCanal_mm ? std::optional(std::move(canal)) : std::nullopt;
}

[[noreturn]] void refuseClicks(bool is_right, const std::string& why) {
  throw LoadError(std::string("clicks: canal on the ") + (is_right ? "right: " : "left: ") + why);
}

CanalProposal clickedCanal(const CanalScene& scene, const Line& clicks, bool is_right) {
  const CellBox around = boxAround(scene.jaw.grid, clicks, kAroundClicks_mm);
  if (around.isEmpty()) refuseClicks(is_right, "its points lie outside the lower jaw");
  const HalfJaw half = halfIn(scene, around, 1);
  if (half.score.empty()) refuseClicks(is_right, "there is hardly any bone between its points");
  std::vector<std::size_t> stops;
  for (std::size_t n = 0; n < clicks.size(); ++n) {
    stops.push_back(boneNear(half, clicks[n]));
    if (stops.back() == half.grid.voxelCount())
      refuseClicks(is_right, "point " + std::to_string(n + 1) + " lies more than 2 mm off the lower jaw");
  }
  std::vector<std::size_t> way{stops.front()};
  for (std::size_t n = 1; n < stops.size(); ++n) {
    const std::vector<std::size_t> next = canalWay(half, std::span(&stops[n - 1], 1), std::span(&stops[n], 1));
    if (next.empty()) refuseClicks(is_right, "no way through bone joins its points");
    way.insert(way.end(), next.begin() + 1, next.end());
  }
  CanalProposal canal;
  canal.is_right = is_right;
  canal.is_confirmed = true;
  if (way.size() > 1) canal.line_P_mm = centredCanal(half, pointsOfWay(half.grid, way), CanalEnds::kept);
  if (wayLength_mm(canal.line_P_mm) < kLeastCanal_mm)
    refuseClicks(is_right, "it is shorter than 15 mm, click both of its ends");
  if (canal.line_P_mm.front().y > canal.line_P_mm.back().y) std::ranges::reverse(canal.line_P_mm);
  return canal;
}

}  // namespace

Line canalClicksOn(const JawArch& arch, std::span<const Line> clicks, bool is_right) {
  const Line* clicked = nullptr;
  for (const Line& line : clicks) {
    double x_P_mm = 0.0;
    for (const glm::dvec3& p : line) x_P_mm += p.x / static_cast<double>(line.size());
    if ((x_P_mm < arch.centre_P_mm.x) != is_right) continue;
    if (clicked != nullptr) refuseClicks(is_right, "it is clicked twice");
    clicked = &line;
  }
  return clicked != nullptr ? *clicked : Line{};
}

std::optional<CanalProposal> canalOn(const CanalScene& scene, const std::vector<FoundTooth>& teeth, const Line& clicks,
                                     bool is_right) {
  return clicks.empty() ? proposedCanal(scene, teeth, is_right) : clickedCanal(scene, clicks, is_right);
}

std::uint64_t canalTeeth(const CanalScene& scene, const std::vector<FoundTooth>& teeth, bool is_right) {
  // FNV-1a over runs of voxels.
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](std::uint64_t word) { hash = (hash ^ word) * 1099511628211ULL; };
  const CellBox half = boxOfHalf(scene, is_right);
  bool was_tooth = false;
  forCells(scene.regions.box.size(), [&](glm::ivec3 ijk, std::size_t n) {
    const glm::ivec3 at = scene.regions.box.low + ijk;
    const bool is_tooth = scene.regions.part[n] != 0 && glm::all(glm::greaterThanEqual(at, half.low)) &&
                          glm::all(glm::lessThan(at, half.end));
    if (is_tooth != was_tooth) add(indexIn(scene.jaw.grid.size, at));
    was_tooth = is_tooth;
  });
  add(std::bit_cast<std::uint64_t>(frontEnd_P_mm(teeth, is_right).value_or(1e9)));
  return hash;
}

}  // namespace assets
