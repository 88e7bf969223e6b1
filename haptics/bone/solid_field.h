// A view of a solid-fraction field: the live bone, or any volume passed to `molar feel`. Frame P, mm. The arrays belong
// to bone/cubelets, whose header draws their layout, and must outlive the view. Blocks have a number, by their place in
// the grid, and a slot, by which the arrays are read; several blocks may share a slot. Outside the grid is air.
// Trivially copyable.
#pragma once

#include <cmath>
#include <cstdint>

#include "assets/volume_grid.h"

namespace haptics {

inline constexpr int kBlockEdge = 4, kBlockVoxels = 64;
/// In SolidField::only_label: the voxels of this block have several labels.
inline constexpr std::uint8_t kMixedLabels = 255;

struct SolidField {
  assets::VolumeGrid grid;
  glm::ivec3 blocks{0};                    ///< along i, j, k
  const std::uint32_t* slot_of = nullptr;  ///< by block, and one value more; null: every block's slot is its number
  const std::uint8_t* solid = nullptr;     ///< 0..255 = fraction of the voxel that is solid
  const std::uint8_t* label = nullptr;     ///< assets::Tissue, same order; null: unlabelled
  const std::uint16_t *weight = nullptr, *weight_x = nullptr, *weight_y = nullptr, *weight_z = nullptr;
  const std::uint32_t* grey = nullptr;
  const std::uint8_t* only_label = nullptr;

  std::size_t blockAt(glm::ivec3 block) const {
    return (static_cast<std::size_t>(block.z) * static_cast<std::size_t>(blocks.y) +
            static_cast<std::size_t>(block.y)) *
               static_cast<std::size_t>(blocks.x) +
           static_cast<std::size_t>(block.x);
  }
  static glm::ivec3 blockOf(glm::ivec3 ijk) { return {ijk.x >> 2, ijk.y >> 2, ijk.z >> 2}; }
  /// Of a voxel among the 64 of its block.
  static std::size_t within(glm::ivec3 ijk) {
    return static_cast<std::size_t>((ijk.z & 3) * 16 + (ijk.y & 3) * 4 + (ijk.x & 3));
  }
  std::size_t slotOf(std::size_t block) const { return slot_of == nullptr ? block : slot_of[block]; }
  std::size_t slotAt(glm::ivec3 block) const { return slotOf(blockAt(block)); }
  /// Index of a voxel of the grid in `solid` and `label`.
  std::size_t offsetOf(glm::ivec3 ijk) const { return slotAt(blockOf(ijk)) * kBlockVoxels + within(ijk); }
  std::uint8_t solidAt(glm::ivec3 ijk) const { return solid[offsetOf(ijk)]; }
  std::uint8_t labelAt(glm::ivec3 ijk) const { return label == nullptr ? std::uint8_t{0} : label[offsetOf(ijk)]; }
};

/// Inclusive box of voxels, clipped to the grid and a margin around it. Clipped as doubles: an extreme pose must not
/// overflow an index.
struct VoxelBox {
  glm::ivec3 first{0}, last{-1};

  VoxelBox() = default;
  /// The voxels with centres in low..high, continuous indices; empty where one is not finite.
  VoxelBox(const assets::VolumeGrid& grid, const glm::dvec3& low, const glm::dvec3& high, int margin = 0) {
    VoxelBox box;
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(low[axis]) || !std::isfinite(high[axis])) return;
      const double from = low[axis] > -margin ? low[axis] : -margin, end = grid.size[axis] - 1 + margin;
      const double to = high[axis] < end ? high[axis] : end;
      if (!(from <= to)) return;
      box.first[axis] = static_cast<int>(std::ceil(from));
      box.last[axis] = static_cast<int>(std::floor(to));
    }
    *this = box;
  }
  bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
};

}  // namespace haptics
