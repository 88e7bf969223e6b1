#include "render/volume/occupancy.h"

#include <algorithm>

#include "assets/ct_volume.h"
#include "render/shaders/shared_numbers.glsl"
#include "render/volume/brick_distance.h"

namespace render {

static_assert(BRICK_VOXELS == assets::kBrickVoxels);

Occupancy::Occupancy(const BorderedField<std::uint8_t>& solid)
    : bricks_((solid.layout().size + (assets::kBrickVoxels - 1)) / assets::kBrickVoxels) {
  const std::size_t count = brickIndex(bricks_ - 1) + 1;
  is_occupied_.resize(count);
  emptiness_.resize(count);
  is_pending_.resize(count);
  for (int k = 0; k < bricks_.z; ++k)
    for (int j = 0; j < bricks_.y; ++j)
      for (int i = 0; i < bricks_.x; ++i) is_occupied_[brickIndex({i, j, k})] = isOccupied(solid, {i, j, k}) ? 1 : 0;
  rebuild();
}

std::size_t Occupancy::brickIndex(glm::ivec3 brick) const {
  return (static_cast<std::size_t>(brick.z) * static_cast<std::size_t>(bricks_.y) + static_cast<std::size_t>(brick.y)) *
             static_cast<std::size_t>(bricks_.x) +
         static_cast<std::size_t>(brick.x);
}

bool Occupancy::isOccupied(const BorderedField<std::uint8_t>& solid, glm::ivec3 brick) {
  const VoxelBox box = grown({brick * assets::kBrickVoxels, glm::ivec3(assets::kBrickVoxels)}, 1, solid.layout().size);
  for (int k = 0; k < box.extent.z; ++k)
    for (int j = 0; j < box.extent.y; ++j) {
      const std::uint8_t* const row = solid.at(box.first + glm::ivec3(0, j, k));
      if (std::any_of(row, row + box.extent.x, [](std::uint8_t value) { return value >= assets::kHalfSolid; }))
        return true;
    }
  return false;
}

void Occupancy::touch(const VoxelBox& box) {
  // Every brick whose border of one voxel reaches in.
  if (box.empty()) return;
  const glm::ivec3 low = glm::max((box.first - 1) / assets::kBrickVoxels, glm::ivec3(0));
  const glm::ivec3 high = glm::min((box.first + box.extent) / assets::kBrickVoxels, bricks_ - 1);
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        if (std::uint8_t& pending = is_pending_[brickIndex({i, j, k})]; pending == 0) {
          pending = 1;
          pending_.push_back({i, j, k});
        }
}

bool Occupancy::refresh(const BorderedField<std::uint8_t>& solid) {
  bool filled = false;
  for (const glm::ivec3& brick : pending_) {
    const std::size_t index = brickIndex(brick);
    const bool was_solid = is_occupied_[index] != 0, is_solid = isOccupied(solid, brick);
    is_occupied_[index] = is_solid ? 1 : 0;
    filled = filled || (is_solid && !was_solid);
    stale_ = stale_ || is_solid != was_solid;
    is_pending_[index] = 0;
  }
  pending_.clear();
  if (filled) rebuild();
  return filled;
}

bool Occupancy::rebuildIfStale(const BorderedField<std::uint8_t>& solid) {
  const bool changed = refresh(solid);
  if (!stale_) return changed;
  rebuild();
  return true;
}

void Occupancy::rebuild() {
  stale_ = false;
  distancesInBricks(bricks_, is_occupied_, kFarthest, emptiness_);
}

}  // namespace render
