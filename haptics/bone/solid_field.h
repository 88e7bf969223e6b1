// A look at a solid-fraction field without owning it: the live bone, or any volume on disk that `feel` is asked about.
// Frame P, mm. Borrowed spans must outlive it. Outside the grid is air. Trivially copyable; a few words.
#pragma once

#include <cstdint>
#include <span>

#include "assets/volume_grid.h"

namespace haptics {

struct SolidField {
  assets::VolumeGrid grid;
  std::span<const std::uint8_t> solid;  ///< 0..255 = fraction of the voxel that is solid, i fastest
  std::span<const std::uint8_t> label;  ///< assets::Tissue, same order, or empty: unlabelled

  /// Of a voxel of the grid. Everything outside contact/overlap and bone/carve reads voxels by these.
  std::uint8_t solidAt(glm::ivec3 ijk) const { return solid[grid.index(ijk)]; }
  std::uint8_t labelAt(glm::ivec3 ijk) const { return label.empty() ? std::uint8_t{0} : label[grid.index(ijk)]; }
};

}  // namespace haptics
