#include "haptics/body/components.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace haptics {

ToothPiece massOf(const VoxelMoments& moments, const assets::VolumeGrid& grid) {
  if (moments.count == 0) return {};
  const double s = grid.spacing_mm, n = static_cast<double>(moments.count);
  const glm::dvec3 mean = glm::dvec3(moments.sum) / n;
  // Second moments about the centroid; a cube of edge 1 has 1/12 along each axis.
  const glm::dvec3 square = glm::dvec3(moments.squares) - n * mean * mean + n / 12.0;
  const glm::dvec3 product =
      glm::dvec3(moments.products) - n * glm::dvec3(mean.y * mean.z, mean.x * mean.z, mean.x * mean.y);
  const glm::dmat3 inertia(square.y + square.z, -product.z, -product.y,  //
                           -product.z, square.x + square.z, -product.x,  //
                           -product.y, -product.x, square.x + square.y);
  return {n * grid.voxelVolume_mm3(), grid.origin_P_mm + s * mean, inertia * (s * s * s * s * s)};
}

Components::Components(const assets::VolumeGrid& grid)
    : grid_(grid), bricks_(grid.bricks()), solid_(assets::countIn(bricks_) * 512, 0), parts_(assets::countIn(bricks_)) {
  join();
}

Components::Components(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid) : Components(grid) {
  assert(solid.size() == grid.voxelCount());
  std::array<std::uint8_t, 512> bytes{};
  forBricks(bricks_, [&](std::size_t, glm::ivec3 corner) {
    std::size_t n = 0;
    assets::forVoxels(corner, corner + assets::kBrickVoxels, [&](glm::ivec3 ijk) {
      bytes[n++] = grid_.contains(ijk) ? solid[grid_.index(ijk)] : std::uint8_t{0};
    });
    update(corner / assets::kBrickVoxels, bytes);
  });
  join();
}

void Components::update(glm::ivec3 brick, std::span<const std::uint8_t, 512> solid) {
  const std::size_t at = assets::indexIn(bricks_, brick);
  std::copy(solid.begin(), solid.end(), solid_.begin() + static_cast<std::ptrdiff_t>(at * 512));
  findParts(solidMask(solid), brick * assets::kBrickVoxels, parts_[at]);
}

void Components::join() {
  join_.unite(bricks_, parts_);
  std::vector<VoxelMoments> of_root(join_.count());
  for (std::size_t brick = 0; brick < parts_.size(); ++brick)
    for (std::size_t part = 0; part < parts_[brick].size(); ++part)
      of_root[join_.rootOf(brick, part)] += parts_[brick][part].moments;

  std::vector<std::size_t> roots;
  for (std::size_t root = 0; root < of_root.size(); ++root)
    if (of_root[root].count > 0) roots.push_back(root);
  std::ranges::stable_sort(roots, [&](std::size_t a, std::size_t b) { return of_root[a].count > of_root[b].count; });
  piece_of_root_.assign(of_root.size(), 0);
  pieces_.clear();
  for (const std::size_t root : roots) {
    piece_of_root_[root] = pieces_.size();
    pieces_.push_back(massOf(of_root[root], grid_));
  }
}

int Components::pieceAt(glm::ivec3 ijk) const {
  if (!grid_.contains(ijk)) return -1;
  const std::size_t brick = brickOf(ijk);
  for (std::size_t part = 0; part < parts_[brick].size(); ++part)
    if (holds(parts_[brick][part].mask, ijk & 7)) return static_cast<int>(pieceOf(brick, part));
  return -1;
}

BrickMask Components::maskOf(std::size_t brick) const {
  BrickMask mask{};
  for (const BrickPart& part : parts_[brick])
    for (std::size_t k = 0; k < mask.size(); ++k) mask[k] |= part.mask[k];
  return mask;
}

}  // namespace haptics
