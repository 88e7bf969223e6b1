#include "render/cpu/crowded_bricks.h"

#include <algorithm>

#include "render/shaders/shared_numbers.glsl"
#include "render/volume/brick_distance.h"

namespace render {
namespace {

constexpr int kCells = BRICK_VOXELS / AMBIENT_CELL_VOXELS;  // along a brick

}  // namespace

CrowdedBricks::CrowdedBricks(const VolumeFields& fields)
    : bricks_(fields.grid().bricks()),
      is_crowded_(static_cast<std::size_t>(bricks_.x) * static_cast<std::size_t>(bricks_.y) *
                  static_cast<std::size_t>(bricks_.z)) {
  for (int k = 0; k < bricks_.z; ++k)
    for (int j = 0; j < bricks_.y; ++j)
      for (int i = 0; i < bricks_.x; ++i) is_crowded_[index({i, j, k})] = isCrowded(fields, {i, j, k}) ? 1 : 0;
  measure();
}

void CrowdedBricks::update(const VolumeFields& fields, const FieldChanges& changes) {
  bool filled = false;
  for (const VoxelBox& cells : changes.ambient) {
    const glm::ivec3 low = glm::max((cells.first - 1) / kCells, glm::ivec3(0));
    const glm::ivec3 high = glm::min((cells.first + cells.extent) / kCells, bricks_ - 1);
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i)
          if (std::uint8_t& crowded = is_crowded_[index({i, j, k})]; crowded == 0 && isCrowded(fields, {i, j, k})) {
            crowded = 1;
            filled = true;
          }
  }
  if (filled) measure();
}

std::size_t CrowdedBricks::index(glm::ivec3 brick) const {
  return (static_cast<std::size_t>(brick.z) * static_cast<std::size_t>(bricks_.y) + static_cast<std::size_t>(brick.y)) *
             static_cast<std::size_t>(bricks_.x) +
         static_cast<std::size_t>(brick.x);
}

// A sample inside a brick touches its cells and one around them.
bool CrowdedBricks::isCrowded(const VolumeFields& fields, glm::ivec3 brick) const {
  const BorderedField<std::uint16_t>& ambient = fields.ambient();
  const glm::ivec3 low = glm::max(kCells * brick - 1, glm::ivec3(0));
  const glm::ivec3 high = glm::min(kCells * (brick + 1), ambient.layout().size - 1);
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j) {
      const std::uint16_t* const row = ambient.at({low.x, j, k});
      if (std::any_of(row, row + (high.x - low.x + 1), [](std::uint16_t mean) { return mean != 0; })) return true;
    }
  return false;
}

void CrowdedBricks::measure() {
  distances_.resize(is_crowded_.size() + 4);
  distancesInBricks(bricks_, is_crowded_, kFarthest, distances_);
}

}  // namespace render
