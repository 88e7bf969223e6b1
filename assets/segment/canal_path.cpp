#include "assets/segment/canal_path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "assets/load_error.h"
#include "assets/scan/exact_distance.h"
#include "assets/segment/cell_filters.h"
#include "assets/segment/cheapest_path.h"
#include "assets/segment/tubeness.h"
#include "assets/trilinear.h"

namespace assets {
namespace {

constexpr double kOverMiddle_mm = 4.0, kOverBite_mm = 12.0, kInside_mm = 1.2, kPathSmooth_mm = 0.35, kTube_mm = 1.1;
constexpr double kEndSlab_mm = 2.5, kRamusOverBite_mm = 2.0, kBehindShare = 0.75, kFrontShare = 0.38,
                 kPremolar_mm = 3.5, kBodyShare = 0.62;
constexpr std::size_t kEndCells = 60, kLeastBoneCells = 1000;
constexpr double kDisc_mm = 1.8, kStep_mm = 1.0, kLeastCanal_mm = 15.0;
constexpr int kCentrings = 3;
constexpr double kAroundClicks_mm = 8.0, kOffBone_mm = 2.0;

using Line = std::vector<glm::dvec3>;

float valueAtShare(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

/// One half of the jaw, up to a little over the bite.
struct HalfJaw {
  VolumeGrid grid;
  std::vector<float> smooth_hu, score;
  CellMask solid, tooth, may_hold;  ///< may_hold: deep in the bone

  bool isUsable() const {
    return static_cast<std::size_t>(std::ranges::count(may_hold, std::uint8_t{1})) > kLeastBoneCells;
  }
  template <class Belongs>
  std::vector<float> valuesWhere(const std::vector<float>& values, const Belongs& belongs) const {
    std::vector<float> some;
    for (std::size_t n = 0; n < values.size(); ++n)
      if (belongs(n)) some.push_back(values[n]);
    return some;
  }
};

/// Cells of the jaw on one side.
CellBox boxOfHalf(const CanalScene& scene, bool is_right) {
  const JawArch& arch = scene.arch;
  const BiteSheet& sheet = scene.sheet;
  const VolumeGrid& grid = scene.jaw.grid;
  const int middle = static_cast<int>(std::lround(grid.indexFromPoint(glm::dvec3(arch.centre_P_mm, 0.0)).x));
  const int over = static_cast<int>(kOverMiddle_mm / grid.spacing_mm);
  const double back_P_mm = grid.centre_P_mm(grid.size - 1).y;
  const double highest_P_mm = std::max(sheet.height_P_mm, sheet.planeHeight_P_mm(arch, back_P_mm)) + kOverBite_mm;
  const int top = static_cast<int>((highest_P_mm - grid.origin_P_mm.z) / grid.spacing_mm);
  CellBox box{glm::ivec3(0), grid.size};
  is_right ? box.end.x = std::clamp(middle + over, 0, grid.size.x)
           : box.low.x = std::clamp(middle - over, 0, grid.size.x);
  box.end.z = std::clamp(top, 0, grid.size.z);
  return box;
}

enum class Ends { guessed, clicked };

HalfJaw halfIn(const CanalScene& scene, const CellBox& box, Ends ends) {
  const Mandible& jaw = scene.jaw;
  const ToothRegions& teeth = scene.regions;
  const VolumeGrid& grid = jaw.grid;
  HalfJaw half;
  half.grid = {glm::max(box.size(), glm::ivec3(0)), grid.spacing_mm, grid.centre_P_mm(box.low)};
  if (box.isEmpty()) return half;
  const glm::ivec3 size = half.grid.size;
  half.solid = croppedTo(box, grid.size, jaw.solid);
  half.tooth.assign(half.solid.size(), 0);
  forCells(teeth.box.size(), [&](glm::ivec3 ijk, std::size_t n) {
    const glm::ivec3 at = teeth.box.low + ijk - box.low;
    if (teeth.part[n] != 0 && half.grid.contains(at)) half.tooth[half.grid.index(at)] = 1;
  });
  // A proposal keeps off teeth as off the bone's surface: along a root the ligament is a dark sheet. Between the ends
  // of a canal that a person knows its roots may touch it.
  CellMask barred(half.solid.size());
  for (std::size_t n = 0; n < barred.size(); ++n)
    barred[n] = half.solid[n] == 0 || (ends == Ends::guessed && half.tooth[n] != 0) ? 1 : 0;
  const std::vector<float> depth_mm = exactDistance_mm(size, grid.spacing_mm, barred);
  half.may_hold.resize(half.solid.size());
  for (std::size_t n = 0; n < barred.size(); ++n)
    half.may_hold[n] = static_cast<double>(depth_mm[n]) > kInside_mm && half.tooth[n] == 0 ? 1 : 0;
  if (!half.isUsable()) return half;

  half.smooth_hu = croppedTo(box, grid.size, jaw.hounsfield);
  const auto holds = [&](std::size_t n) { return half.may_hold[n] != 0; };
  const float usual_hu = valueAtShare(half.valuesWhere(half.smooth_hu, holds), 0.5);
  for (std::size_t n = 0; n < barred.size(); ++n)
    if (!holds(n)) half.smooth_hu[n] = usual_hu;
  smoothCells(size, kPathSmooth_mm / grid.spacing_mm, half.smooth_hu);
  half.score = darkTubeness(size, kTube_mm / grid.spacing_mm, half.smooth_hu);
  const float tube = std::max(1.0F, valueAtShare(half.valuesWhere(half.score, holds), 0.97));
  const float bright_hu = valueAtShare(half.valuesWhere(half.smooth_hu, holds), 0.75);
  for (std::size_t n = 0; n < barred.size(); ++n)
    half.score[n] = 0.7F * std::clamp(half.score[n] / tube, 0.0F, 2.0F) +
                    0.5F * std::clamp((bright_hu - half.smooth_hu[n]) / 500.0F, 0.0F, 1.5F);
  return half;
}

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

/// What a step through each cell costs.
std::vector<float> costOf(const HalfJaw& half, Ends ends) {
  // Where a person gave the ends, a detour through marrow is worse than a stretch that hardly looks like canal.
  const float least = ends == Ends::guessed ? 0.03F : 0.25F;
  std::vector<float> cost(half.score.size(), 0.0F);
  for (std::size_t n = 0; n < cost.size(); ++n)
    if (half.solid[n] != 0) cost[n] = half.may_hold[n] != 0 ? least + std::exp(-2.2F * half.score[n]) : 6.0F;
  return cost;
}

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

  return cheapestPath(half.grid.size, costOf(half, Ends::guessed), body, ramus);
}

/// Means over as many neighbours on either side, fewer towards the ends, which stay in place.
Line smoothedLine(const Line& line, double sigma) {
  const int reach = static_cast<int>(3.0 * sigma) + 1, count = static_cast<int>(line.size());
  Line out;
  for (int p = 0; p < count; ++p) {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    const int own_reach = std::min({reach, p, count - 1 - p});
    for (int d = -own_reach; d <= own_reach; ++d) {
      const double weight = std::exp(-0.5 * d * d / (sigma * sigma));
      sum += weight * line[static_cast<std::size_t>(p + d)];
      weights += weight;
    }
    out.push_back(sum / weights);
  }
  return out;
}

/// Drawn to the darkness in a disc across the line.
void centre(const HalfJaw& half, Line& line) {
  const double spacing_mm = half.grid.spacing_mm;
  const int reach = static_cast<int>(std::ceil(kDisc_mm / spacing_mm));
  const VolumeGrid cells{half.grid.size, 1.0, glm::dvec3(0.0)};
  const auto hounsfield_at = [&](glm::ivec3 ijk) {
    return half.smooth_hu[cells.index(glm::clamp(ijk, glm::ivec3(0), cells.size - 1))];
  };
  for (int round = 0; round < kCentrings; ++round) {
    const Line course = smoothedLine(line, 3.0);
    for (std::size_t p = 0; p < line.size(); ++p) {
      const glm::dvec3 along = course[std::min(p + 1, line.size() - 1)] - course[p > 0 ? p - 1 : 0];
      const glm::dvec3 tangent = along / std::max(glm::length(along), 1e-9);
      std::vector<glm::dvec3> away;
      std::vector<float> hu;
      forVoxels(glm::ivec3(-reach), glm::ivec3(reach + 1), [&](glm::ivec3 step) {
        const glm::dvec3 d(step);
        if (glm::length(d) * spacing_mm >= kDisc_mm) return;
        away.push_back(d - glm::dot(d, tangent) * tangent);
        hu.push_back(static_cast<float>(trilinearAt(cells, line[p] + away.back(), hounsfield_at)));
      });
      const float dark_hu = valueAtShare(hu, 0.45);
      glm::dvec3 pull(0.0);
      double weights = 1e-9;
      for (std::size_t n = 0; n < hu.size(); ++n) {
        const auto weight = static_cast<double>(std::clamp(dark_hu - hu[n], 0.0F, 400.0F));
        pull += weight * away[n], weights += weight;
      }
      line[p] += 0.7 * pull / weights;
    }
    line = smoothedLine(line, 1.2 / spacing_mm);
  }
}

/// Points a step apart, the ends among them.
Line spacedEvenly(const Line& line) {
  double length_mm = 0.0;
  for (std::size_t p = 1; p < line.size(); ++p) length_mm += glm::distance(line[p - 1], line[p]);
  const int steps = std::max(1, static_cast<int>(std::lround(length_mm / kStep_mm)));
  Line out{line.front()};
  double walked_mm = 0.0;
  for (std::size_t p = 1; p < line.size(); ++p) {
    const double piece_mm = glm::distance(line[p - 1], line[p]);
    while (static_cast<int>(out.size()) < steps &&
           walked_mm + piece_mm >= length_mm * static_cast<double>(out.size()) / steps && piece_mm > 0.0) {
      const double share = (length_mm * static_cast<double>(out.size()) / steps - walked_mm) / piece_mm;
      out.push_back(glm::mix(line[p - 1], line[p], share));
    }
    walked_mm += piece_mm;
  }
  out.push_back(line.back());
  return length_mm < kLeastCanal_mm ? Line{} : out;
}

/// Cells of a way, centred, as points a step apart in P.
Line lineThrough(const HalfJaw& half, const std::vector<std::size_t>& way) {
  Line line;
  for (const std::size_t cell : way) line.emplace_back(elementAt(half.grid.size, cell));
  if (line.size() < 2) return {};
  centre(half, line);
  for (glm::dvec3& p : line) p = half.grid.origin_P_mm + half.grid.spacing_mm * p;
  return spacedEvenly(line);
}

std::optional<CanalProposal> proposedCanal(const CanalScene& scene, const std::vector<FoundTooth>& teeth,
                                           bool is_right) {
  const HalfJaw half = halfIn(scene, boxOfHalf(scene, is_right), Ends::guessed);
  if (half.score.empty()) return std::nullopt;
  const VolumeGrid& grid = half.grid;
  const double middle_P_mm = scene.arch.centre_P_mm.y - 20.0;
  EndPlaces ends{(scene.sheet.planeHeight_P_mm(scene.arch, middle_P_mm) - grid.origin_P_mm.z) / grid.spacing_mm,
                 scene.sheet.slope, (middle_P_mm - grid.origin_P_mm.y) / grid.spacing_mm,
                 frontEnd_P_mm(teeth, is_right)};
  if (ends.front_j) ends.front_j = (*ends.front_j - grid.origin_P_mm.y) / grid.spacing_mm;
  CanalProposal canal;
  canal.is_right = is_right;
  canal.line_P_mm = lineThrough(half, pathThrough(half, ends));
  return canal.line_P_mm.size() >= 2 ? std::optional(std::move(canal)) : std::nullopt;
}

[[noreturn]] void refuseClicks(bool is_right, const std::string& why) {
  throw LoadError(std::string("clicks: canal on the ") + (is_right ? "right: " : "left: ") + why);
}

/// The jaw's cell that is nearest to a click.
std::optional<std::size_t> boneAt(const HalfJaw& half, const glm::dvec3& p_P_mm) {
  std::optional<std::size_t> nearest;
  double least_mm = 2.0 * kOffBone_mm;
  const VolumeGrid& grid = half.grid;
  forCellsNear(grid.indexFromPoint(p_P_mm), kOffBone_mm, grid.spacing_mm, grid.size,
               [&](glm::ivec3 ijk, double away_mm) {
                 if (half.solid[grid.index(ijk)] != 0 && away_mm < least_mm)
                   least_mm = away_mm, nearest = grid.index(ijk);
               });
  return nearest;
}

CanalProposal clickedCanal(const CanalScene& scene, const Line& clicks, bool is_right) {
  const VolumeGrid& grid = scene.jaw.grid;
  glm::dvec3 low_P_mm = clicks.front(), high_P_mm = clicks.front();
  for (const glm::dvec3& p : clicks) low_P_mm = glm::min(low_P_mm, p), high_P_mm = glm::max(high_P_mm, p);
  const glm::dvec3 far = glm::dvec3(grid.size) + 1e3;
  const auto cell_at = [&](const glm::dvec3& p_P_mm) {
    return glm::ivec3(glm::clamp(glm::floor(grid.indexFromPoint(p_P_mm)), -far, far));
  };
  const CellBox around =
      CellBox{cell_at(low_P_mm - kAroundClicks_mm), cell_at(high_P_mm + kAroundClicks_mm) + 2}.grown(0, grid.size);
  if (around.isEmpty()) refuseClicks(is_right, "its points lie outside the lower jaw");
  const HalfJaw half = halfIn(scene, around, Ends::clicked);
  if (half.score.empty()) refuseClicks(is_right, "there is hardly any bone between its points");
  std::vector<std::size_t> stops;
  for (std::size_t n = 0; n < clicks.size(); ++n) {
    const auto cell = boneAt(half, clicks[n]);
    if (!cell) refuseClicks(is_right, "point " + std::to_string(n + 1) + " lies more than 2 mm off the lower jaw");
    stops.push_back(*cell);
  }
  const std::vector<float> cost = costOf(half, Ends::clicked);
  std::vector<std::size_t> way{stops.front()};
  for (std::size_t n = 1; n < stops.size(); ++n) {
    const std::vector<std::size_t> next =
        cheapestPath(half.grid.size, cost, std::span(&stops[n - 1], 1), std::span(&stops[n], 1));
    if (next.empty()) refuseClicks(is_right, "no way through bone joins its points");
    way.insert(way.end(), next.begin() + 1, next.end());
  }
  CanalProposal canal;
  canal.is_right = is_right;
  canal.is_confirmed = true;
  canal.line_P_mm = lineThrough(half, way);
  if (canal.line_P_mm.size() < 2) refuseClicks(is_right, "it is shorter than 15 mm, click both of its ends");
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

}  // namespace assets
