#include "render/volume/volume_fields.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "render/gpu/gpu_error.h"
#include "render/shaders/shared_constants.glsl"
#include "render/volume/appearance_field.h"

namespace render {
namespace {

constexpr int kB = assets::kBrickVoxels;
constexpr int kEdge = AMBIENT_CELL_VOXELS;

const assets::VolumeGrid& checked(const assets::VolumeGrid& grid, std::size_t solid, std::size_t label) {
  if (grid.voxelCount() == 0 || !(grid.spacing_mm > 0.0) || solid != grid.voxelCount() ||
      (label != 0 && label != grid.voxelCount()))
    throw GpuError("volume of " + std::to_string(grid.voxelCount()) + " voxels, renderer: got " +
                   std::to_string(solid) + " solid values and " + std::to_string(label) +
                   " labels; give one of each per voxel");
  return grid;
}

BorderedField<std::uint8_t> bordered(const assets::VolumeGrid& grid, std::span<const std::uint8_t> values) {
  BorderedField<std::uint8_t> field(grid.size);
  if (values.empty()) return field;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j) std::copy_n(&values[grid.index({0, j, k})], grid.size.x, field.at({0, j, k}));
  return field;
}

// Merges boxes that are close together.
std::vector<VoxelBox> gathered(const std::vector<VoxelBox>& boxes) {
  VoxelBox all;
  std::size_t sum = 0;
  for (const VoxelBox& box : boxes) {
    all = boxAround(all, box);
    sum += grown(box, kSmoothReach, glm::ivec3(1 << 30)).count();
  }
  if (boxes.size() > 1 && all.count() > 2 * sum) return boxes;
  return {all};
}

}  // namespace

VolumeFields::VolumeFields(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                           std::span<const std::uint8_t> label)
    : grid_(checked(grid, solid.size(), label.size())),
      solid_(bordered(grid, solid)),
      smooth_(grid.size),
      ambient_(grid.bricks() * (kB / kEdge)),
      appearance_(appearanceField(solid_, label)),
      label_(bordered(grid, label)) {
  // In slabs of a brick's height, to limit the working memory.
  tbb::parallel_for(0, grid.bricks().z, [&](int slab) {
    Smoother smoother;
    smoother.smooth(solid_, {{0, 0, kB * slab}, {grid.size.x, grid.size.y, std::min(kB, grid.size.z - kB * slab)}},
                    smooth_);
  });
  meanCells({{0, 0, 0}, ambient_.layout().size});
}

void VolumeFields::updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values) {
  assert(glm::all(glm::greaterThanEqual(brick, glm::ivec3(0))) && glm::all(glm::lessThan(brick, grid_.bricks())));
  const glm::ivec3 first = kB * brick, extent = glm::min(glm::ivec3(kB), grid_.size - first);
  glm::ivec3 low(kB), high(-1);
  for (int k = 0; k < extent.z; ++k)
    for (int j = 0; j < extent.y; ++j) {
      const auto from = values.begin() + (k * kB + j) * kB;
      std::uint8_t* const to = solid_.at(first + glm::ivec3(0, j, k));
      for (int i = 0; i < extent.x; ++i)
        if (to[i] != from[i]) {
          to[i] = from[i];
          low = glm::min(low, glm::ivec3(i, j, k));
          high = glm::max(high, glm::ivec3(i, j, k));
        }
    }
  if (high.x < 0) return;
  touched_.push_back({first + low, high - low + 1});
}

void VolumeFields::meanCells(const VoxelBox& cells) {
  forEachIn(cells, [this](glm::ivec3 cell) {
    std::uint32_t sum = 0;
    forEachIn(grown({kEdge * cell, glm::ivec3(kEdge)}, 0, grid_.size),
              [&](glm::ivec3 voxel) { sum += *solid_.at(voxel); });
    *ambient_.at(cell) = static_cast<std::uint16_t>(sum * 257u / (kEdge * kEdge * kEdge));
  });
}

const FieldChanges& VolumeFields::prepare() {
  changes_.solid.clear(), changes_.smooth.clear(), changes_.ambient.clear();
  if (!touched_.empty()) changes_.solid = gathered(touched_);
  touched_.clear();
  for (const VoxelBox& box : changes_.solid) {
    changes_.smooth.push_back(grown(box, kSmoothReach, grid_.size));
    smoother_.smooth(solid_, changes_.smooth.back(), smooth_);
    const glm::ivec3 first = box.first / kEdge;
    changes_.ambient.push_back({first, (box.first + box.extent - 1) / kEdge + 1 - first});
    meanCells(changes_.ambient.back());
  }
  return changes_;
}

}  // namespace render
