#include "app/session/measures/section_left.h"

#include <algorithm>
#include <array>
#include <vector>

#include "haptics/body/tooth_survey.h"

namespace app {

std::optional<SectionLeft> sectionLeft(const RemovalClock& clock, std::span<const std::uint8_t> before,
                                       std::span<const std::uint8_t> after, std::span<const std::uint8_t> is_tooth,
                                       std::optional<double> t_s) {
  const assets::VolumeGrid& whole = clock.grid();
  glm::ivec3 low = whole.size, end(0);
  assets::forVoxels(whole, [&](glm::ivec3 ijk, std::size_t v) {
    if (is_tooth[v] != 0) low = glm::min(low, ijk), end = glm::max(end, ijk + 1);
  });
  if (low.x >= end.x) return {};
  const assets::VolumeGrid grid{end - low, whole.spacing_mm, whole.centre_P_mm(low)};
  std::vector<std::uint8_t> solid(grid.voxelCount(), 0);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::size_t at = whole.index(low + ijk);
    if (is_tooth[at] != 0) solid[v] = before[at];
  });
  haptics::ToothSurvey survey(grid, solid);
  for (const RemovedVoxel& voxel : clock.removed())
    if (is_tooth[voxel.index] != 0 && voxel.t_s && (!t_s || *voxel.t_s < *t_s))
      solid[grid.index(voxel.ijk - low)] = after[voxel.index];
  assets::forVoxels(glm::ivec3(0), grid.bricks(), [&](glm::ivec3 brick) {
    std::array<std::uint8_t, 512> bytes{};
    std::size_t n = 0;
    assets::forVoxels(glm::ivec3(0), glm::ivec3(assets::kBrickVoxels), [&](glm::ivec3 in) {
      const glm::ivec3 ijk = assets::kBrickVoxels * brick + in;
      if (grid.contains(ijk)) bytes[n] = solid[grid.index(ijk)];
      ++n;
    });
    survey.update(brick, bytes);
  });
  haptics::ToothFindings found = survey.pieces();
  survey.findBridges(found, haptics::kBridgeCell_mm);
  std::optional<SectionLeft> thinnest;
  for (std::size_t n = 0; n < std::min(found.pieces, haptics::kMostPieces); ++n) {
    const haptics::ToothFindings::Held& held = found.held[n];
    for (std::size_t b = 0; held.parts > 1 && b < std::min(held.bridges, held.bridge.size()); ++b)
      if (!thinnest || held.bridge[b].thickness_mm < thinnest->thickness_mm)
        thinnest = {held.bridge[b].thickness_mm, held.bridge[b].area_mm2};
  }
  return thinnest;
}

}  // namespace app
