#include "render/volume/occupancy.h"

#include <algorithm>
#include <cassert>

#include "render/shaders/shared_numbers.glsl"

namespace render {

static_assert(BRICK_VOXELS == assets::kBrickVoxels);

Occupancy::Occupancy(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid)
    : grid_(grid), bricks_(grid.bricks()), solid_(solid.begin(), solid.end()) {
  assert(solid.size() == grid.voxelCount());
  const std::size_t count = brickIndex(bricks_ - 1) + 1;
  largest_.resize(count);
  emptiness_.resize(count);
  is_pending_.resize(count);
  for (int k = 0; k < bricks_.z; ++k)
    for (int j = 0; j < bricks_.y; ++j)
      for (int i = 0; i < bricks_.x; ++i) largest_[brickIndex({i, j, k})] = largestAround({i, j, k});
  rebuild();
}

std::size_t Occupancy::brickIndex(glm::ivec3 brick) const {
  return (static_cast<std::size_t>(brick.z) * static_cast<std::size_t>(bricks_.y) + static_cast<std::size_t>(brick.y)) *
             static_cast<std::size_t>(bricks_.x) +
         static_cast<std::size_t>(brick.x);
}

std::uint8_t Occupancy::largestAround(glm::ivec3 brick) const {
  const glm::ivec3 first = glm::max(brick * assets::kBrickVoxels - 1, glm::ivec3(0));
  const glm::ivec3 last = glm::min((brick + 1) * assets::kBrickVoxels, grid_.size - 1);
  std::uint8_t largest = 0;
  for (int k = first.z; k <= last.z; ++k)
    for (int j = first.y; j <= last.y; ++j) {
      const auto row = solid_.begin() + static_cast<std::ptrdiff_t>(grid_.index({first.x, j, k}));
      largest = std::max(largest, *std::max_element(row, row + (last.x - first.x + 1)));
    }
  return largest;
}

void Occupancy::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, kBrickValues> values) {
  // The voxels themselves.
  const glm::ivec3 first = brick * assets::kBrickVoxels;
  const glm::ivec3 extent = glm::min(glm::ivec3(assets::kBrickVoxels), grid_.size - first);
  for (int k = 0; k < extent.z; ++k)
    for (int j = 0; j < extent.y; ++j) {
      const auto row = values.begin() + (k * assets::kBrickVoxels + j) * assets::kBrickVoxels;
      std::copy(row, row + extent.x,
                solid_.begin() + static_cast<std::ptrdiff_t>(grid_.index(first + glm::ivec3(0, j, k))));
    }

  // Every brick whose border of one voxel reaches in.
  const glm::ivec3 low = glm::max(brick - 1, glm::ivec3(0)), high = glm::min(brick + 1, bricks_ - 1);
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        if (std::uint8_t& pending = is_pending_[brickIndex({i, j, k})]; pending == 0) {
          pending = 1;
          pending_.push_back({i, j, k});
        }
}

bool Occupancy::refresh() {
  bool filled = false;
  for (const glm::ivec3& brick : pending_) {
    const std::size_t index = brickIndex(brick);
    const bool was_solid = largest_[index] >= kSolidFrom;
    largest_[index] = largestAround(brick);
    const bool is_solid = largest_[index] >= kSolidFrom;
    filled = filled || (is_solid && !was_solid);
    stale_ = stale_ || is_solid != was_solid;
    is_pending_[index] = 0;
  }
  pending_.clear();
  if (filled) rebuild();
  return filled;
}

bool Occupancy::rebuildIfStale() {
  const bool changed = refresh();
  if (!stale_) return changed;
  rebuild();
  return true;
}

// Two raster scans over the 26 neighbours give the chessboard distance exactly (Rosenfeld & Pfaltz 1968).
void Occupancy::rebuild() {
  stale_ = false;
  for (std::size_t b = 0; b < largest_.size(); ++b) emptiness_[b] = largest_[b] >= kSolidFrom ? 0 : kFarthest;
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
