// A scanned jaw as loaded: Hounsfield units, tissue labels, teeth by number and the solid fraction, voxel for voxel on
// one grid. Immutable after loading; any thread may read. 5 bytes a voxel. Not the bone while it is carved
// (haptics::CarvedBone).
#pragma once

#include <cstdint>
#include <vector>

#include "assets/tissue.h"
#include "assets/volume_grid.h"

namespace assets {

/// Of CtVolume::solid: from here on a voxel is more solid than not.
inline constexpr std::uint8_t kHalfSolid = 128;

struct CtVolume {
  VolumeGrid grid;
  std::vector<std::int16_t> hounsfield;  ///< grid.voxelCount() values, i fastest
  std::vector<std::uint8_t> label;       ///< Tissue, same order
  std::vector<std::uint8_t> solid;       ///< 0..255 = fraction of the voxel that is solid: what is felt and seen
  std::vector<std::uint8_t> tooth;  ///< FDI number of the tooth a voxel belongs to, 0 none; empty: no tooth told apart
};

}  // namespace assets
