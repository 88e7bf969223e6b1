#include <algorithm>
#include <map>
#include <utility>

#include "haptics/ligament/root_load.h"

namespace haptics {
namespace {

/// A sample lies on the surface: what is under it tells.
std::uint16_t beyondAt(const RootSections& found, const assets::VolumeGrid& grid, const glm::dvec3& p_Q_mm,
                       const glm::dvec3& outward) {
  for (const double deep : {0.5, 1.0, 1.5}) {
    const glm::ivec3 ijk(glm::round(grid.indexFromPoint(p_Q_mm - deep * grid.spacing_mm * outward)));
    if (!grid.contains(ijk)) continue;
    if (const std::uint16_t bits = found.beyond[grid.index(ijk)]; bits != 0) return bits;
  }
  return 0;
}

void append(const PieceSamples& samples, std::int32_t sample, RootGroups& groups) {
  const bool is_padding = sample < 0;
  const auto n = static_cast<std::size_t>(std::max(sample, 0));
  groups.sample.push_back(sample);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    groups.place_mm[axis].push_back(is_padding ? 0.0F : samples.place_mm[axis][n]);
    groups.normal[axis].push_back(is_padding ? 0.0F : samples.normal[axis][n]);
  }
  groups.area_mm2.push_back(is_padding ? 0.0F : samples.area_mm2[n]);
  groups.width_mm.push_back(is_padding ? 1.0F : samples.width_mm[n]);
}

}  // namespace

RootGroups rootGroups(RootSections found, const assets::VolumeGrid& grid, const PieceSamples& samples) {
  std::map<std::pair<std::uint16_t, bool>, std::vector<std::int32_t>> members;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    if (samples.area_mm2[n] == 0.0F) continue;
    glm::dvec3 place_mm = samples.centre_Q_mm, outward(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      place_mm[axis] += static_cast<double>(samples.place_mm[axis][n]);
      outward[axis] = static_cast<double>(samples.normal[axis][n]);
    }
    if (const std::uint16_t bits = beyondAt(found, grid, place_mm, outward); bits != 0)
      members[{bits, n < samples.ligament}].push_back(static_cast<std::int32_t>(n));
  }
  RootGroups groups;
  groups.sections = std::move(found.sections);
  constexpr std::size_t kMost = RootGroups::kMostRows * kSampleLanes;
  for (const auto& [key, all] : members)
    for (std::size_t from = 0; from < all.size(); from += kMost) {
      const std::size_t end = std::min(from + kMost, all.size());
      RootGroups::Chunk chunk{static_cast<int>(groups.sample.size()), 0, key.first, key.second};
      for (std::size_t n = from; n < end; ++n) append(samples, all[n], groups);
      while (groups.sample.size() % kSampleLanes != 0) append(samples, -1, groups);
      chunk.count = static_cast<int>(groups.sample.size()) - chunk.first;
      groups.chunks.push_back(chunk);
    }
  return groups;
}

}  // namespace haptics
