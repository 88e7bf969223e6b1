#include "app/session/measures/trough.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace app {
namespace {

constexpr double kHalf = 0.5;              ///< a voxel of which less is gone is the cut's rim
constexpr std::size_t kLeastColumns = 10;  ///< of a floor
constexpr std::size_t kLeastGouge = 3;     ///< columns; fewer are noise

struct Station {
  double removed_mm3 = 0.0, depth_mm = 0.0;
  std::set<int> columns;  ///< across, a voxel wide
};

Evenness evennessOf(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value, squares += value * value;
  const auto n = static_cast<double>(values.size());
  const double mean = sum / n;
  return {mean, mean > 0.0 ? std::sqrt(std::max(0.0, squares / n - mean * mean)) / mean : 0.0};
}

double middleOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// A map of the cut's floor: the lowest place of what is gone, by column.
struct Floor {
  glm::ivec2 size{0};
  std::vector<double> height_mm;  ///< NaN: not cut
  double column_mm = 0.0;

  bool isCut(glm::ivec2 at) const {
    return at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y && !std::isnan(height(at));
  }
  double height(glm::ivec2 at) const { return height_mm[place(at)]; }
  std::size_t place(glm::ivec2 at) const {
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(at.x);
  }
};

Floor floorOf(const RemovalClock& clock, const CutAxes& axes, const std::function<bool(std::size_t)>& counts) {
  constexpr double kColumn_voxels = 1.5;
  Floor floor;
  floor.column_mm = kColumn_voxels * clock.grid().spacing_mm;
  std::vector<std::pair<glm::ivec2, double>> places;
  glm::ivec2 low(std::numeric_limits<int>::max()), high(std::numeric_limits<int>::min());
  for (const RemovedVoxel& voxel : clock.removed()) {
    if (voxel.share < kHalf || !counts(voxel.index)) continue;
    const glm::dvec3 p = clock.grid().centre_P_mm(voxel.ijk);
    const glm::ivec2 at(
        glm::floor(glm::dvec2(glm::dot(p, axes.along_P), glm::dot(p, axes.across_P)) / floor.column_mm));
    places.emplace_back(at, glm::dot(p, axes.outward_P));
    low = glm::min(low, at), high = glm::max(high, at);
  }
  if (places.empty()) return floor;
  floor.size = high - low + 1;
  floor.height_mm.assign(static_cast<std::size_t>(floor.size.x) * static_cast<std::size_t>(floor.size.y),
                         std::numeric_limits<double>::quiet_NaN());
  for (const auto& [at, mm] : places) {
    double& here = floor.height_mm[floor.place(at - low)];
    if (!(here <= mm)) here = mm;
  }
  return floor;
}

}  // namespace

std::optional<TroughProfile> troughProfile(const RemovalClock& clock, const CutAxes& axes,
                                           const std::function<bool(std::size_t)>& counts,
                                           const std::function<double(const glm::dvec3&)>& depth_mm) {
  const double h = clock.grid().spacing_mm, voxel_mm3 = clock.grid().voxelVolume_mm3();
  std::map<int, Station> stations;
  for (const RemovedVoxel& voxel : clock.removed()) {
    if (!counts(voxel.index)) continue;
    const glm::dvec3 p = clock.grid().centre_P_mm(voxel.ijk);
    Station& station = stations[static_cast<int>(std::floor(glm::dot(p, axes.along_P) / kStation_mm))];
    station.removed_mm3 += voxel.share * voxel_mm3;
    // A voxel at the surface was half air.
    if (voxel.share >= 0.5 * kHalf)
      station.columns.insert(static_cast<int>(std::floor(glm::dot(p, axes.across_P) / h)));
    if (voxel.share >= kHalf) station.depth_mm = std::max(station.depth_mm, depth_mm(p) + 0.5 * h);
  }
  constexpr std::size_t kLeastStations = 3;
  if (stations.size() < kLeastStations) return {};
  std::vector<double> removed_mm3;
  for (const auto& [at, station] : stations) removed_mm3.push_back(station.removed_mm3);
  const double least_mm3 = 0.5 * middleOf(removed_mm3);
  std::vector<double> depths, widths, sections;
  for (const auto& [at, station] : stations) {
    if (station.removed_mm3 < least_mm3 || station.columns.empty()) continue;
    depths.push_back(station.depth_mm);
    widths.push_back(h * static_cast<double>(station.columns.size()));
    sections.push_back(station.removed_mm3 / kStation_mm);
  }
  if (depths.size() < kLeastStations) return {};
  return TroughProfile{evennessOf(depths), evennessOf(widths), evennessOf(sections).mean,
                       kStation_mm * static_cast<double>(depths.size())};
}

std::optional<Gouges> gougesIn(const RemovalClock& clock, const CutAxes& axes,
                               const std::function<bool(std::size_t)>& counts) {
  const Floor floor = floorOf(clock, axes, counts);
  const auto cut =
      static_cast<std::size_t>(std::ranges::count_if(floor.height_mm, [](double mm) { return !std::isnan(mm); }));
  if (cut < kLeastColumns) return {};
  const int reach = static_cast<int>(kAroundGouge_mm / floor.column_mm);
  std::vector<double> below_mm(floor.height_mm.size(), 0.0), around;
  const auto for_columns = [&](glm::ivec2 low, glm::ivec2 end, const auto& visit) {
    for (int y = low.y; y < end.y; ++y)
      for (int x = low.x; x < end.x; ++x)
        if (floor.isCut({x, y})) visit(glm::ivec2(x, y));
  };
  for_columns(glm::ivec2(0), floor.size, [&](glm::ivec2 at) {
    around.clear();
    for_columns(at - reach, at + reach + 1, [&](glm::ivec2 near) {
      const glm::ivec2 off = near - at;
      if (off.x * off.x + off.y * off.y <= reach * reach) around.push_back(floor.height(near));
    });
    below_mm[floor.place(at)] = middleOf(around) - floor.height(at);
  });

  Gouges found;
  std::vector<bool> is_taken(below_mm.size(), false);
  const auto is_deep = [&](glm::ivec2 at) {
    return floor.isCut(at) && !is_taken[floor.place(at)] && below_mm[floor.place(at)] > kGouge_mm;
  };
  std::vector<glm::ivec2> part;
  for_columns(glm::ivec2(0), floor.size, [&](glm::ivec2 first) {
    if (!is_deep(first)) return;
    is_taken[floor.place(first)] = true;
    part.assign(1, first);
    double deepest_mm = 0.0;
    for (std::size_t n = 0; n < part.size(); ++n) {
      const glm::ivec2 middle = part[n];
      deepest_mm = std::max(deepest_mm, below_mm[floor.place(middle)]);
      for (int y = middle.y - 1; y <= middle.y + 1; ++y)
        for (int x = middle.x - 1; x <= middle.x + 1; ++x)
          if (is_deep({x, y})) is_taken[floor.place({x, y})] = true, part.emplace_back(x, y);
    }
    if (part.size() < kLeastGouge) return;
    ++found.count;
    found.deepest_mm = std::max(found.deepest_mm, deepest_mm);
  });
  return found;
}

}  // namespace app
