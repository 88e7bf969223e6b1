#include "render/volume/occupancy.h"

#include <algorithm>

#include "render/shaders/shared_numbers.glsl"

namespace render {

static_assert(BRICK_VOXELS == assets::kBrickVoxels);

Occupancy::Occupancy(const BorderedField<std::uint8_t>& solid, std::uint8_t visible_from)
    : bricks_((solid.layout().size + (assets::kBrickVoxels - 1)) / assets::kBrickVoxels), visible_from_(visible_from) {
  const std::size_t count = brickIndex(bricks_ - 1) + 1;
  largest_.resize(count);
  emptiness_.resize(count);
  is_pending_.resize(count);
  for (int k = 0; k < bricks_.z; ++k)
    for (int j = 0; j < bricks_.y; ++j)
      for (int i = 0; i < bricks_.x; ++i) largest_[brickIndex({i, j, k})] = largestAround(solid, {i, j, k});
  rebuild();
}

std::size_t Occupancy::brickIndex(glm::ivec3 brick) const {
  return (static_cast<std::size_t>(brick.z) * static_cast<std::size_t>(bricks_.y) + static_cast<std::size_t>(brick.y)) *
             static_cast<std::size_t>(bricks_.x) +
         static_cast<std::size_t>(brick.x);
}

std::uint8_t Occupancy::largestAround(const BorderedField<std::uint8_t>& solid, glm::ivec3 brick) const {
  const VoxelBox box = grown({brick * assets::kBrickVoxels, glm::ivec3(assets::kBrickVoxels)}, 1, solid.layout().size);
  std::uint8_t largest = 0;
  for (int k = 0; k < box.extent.z; ++k)
    for (int j = 0; j < box.extent.y; ++j) {
      const std::uint8_t* const row = solid.at(box.first + glm::ivec3(0, j, k));
      for (int i = 0; i < box.extent.x; ++i) largest = std::max(largest, row[i]);
      if (largest == 255) return largest;
    }
  return largest;
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

void Occupancy::setVisibleFrom(std::uint8_t value) {
  rebuild_now_ = rebuild_now_ || value != visible_from_;
  visible_from_ = value;
}

bool Occupancy::refresh(const BorderedField<std::uint8_t>& solid) {
  bool filled = rebuild_now_;
  for (const glm::ivec3& brick : pending_) {
    const std::size_t index = brickIndex(brick);
    const bool was_solid = largest_[index] >= visible_from_;
    largest_[index] = largestAround(solid, brick);
    const bool is_solid = largest_[index] >= visible_from_;
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

// Two raster scans over the 26 neighbours give the chessboard distance exactly (Rosenfeld & Pfaltz 1968).
void Occupancy::rebuild() {
  stale_ = rebuild_now_ = false;
  for (std::size_t b = 0; b < largest_.size(); ++b) emptiness_[b] = largest_[b] >= visible_from_ ? 0 : kFarthest;
  const auto nearer = [this](glm::ivec3 at, int direction) {
    std::uint8_t best = emptiness_[brickIndex(at)];
    for (int n = 0; n < 13; ++n) {
      const glm::ivec3 neighbour = at + direction * (glm::ivec3(n % 3, (n / 3) % 3, n / 9) - 1);
      if (glm::any(glm::lessThan(neighbour, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(neighbour, bricks_)))
        continue;
      best = std::min<std::uint8_t>(best, static_cast<std::uint8_t>(emptiness_[brickIndex(neighbour)] + 1));
    }
    emptiness_[brickIndex(at)] = best;
  };
  for (int k = 0; k < bricks_.z; ++k)
    for (int j = 0; j < bricks_.y; ++j)
      for (int i = 0; i < bricks_.x; ++i) nearer({i, j, k}, 1);
  for (int k = bricks_.z - 1; k >= 0; --k)
    for (int j = bricks_.y - 1; j >= 0; --j)
      for (int i = bricks_.x - 1; i >= 0; --i) nearer({i, j, k}, -1);
}

}  // namespace render
