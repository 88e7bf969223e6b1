// CT volume of a jaw: Hounsfield values, tissue labels, tooth numbers and solid fraction, one value per voxel of one
// grid. Immutable after loading; any thread may read. 5 bytes a voxel. The carved bone is haptics::CarvedBone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "assets/tissue.h"
#include "assets/volume_grid.h"

namespace assets {

/// Smallest value of CtVolume::solid that counts as solid.
inline constexpr std::uint8_t kHalfSolid = 128;

struct CtVolume {
  VolumeGrid grid;
  std::vector<std::int16_t> hounsfield;  ///< grid.voxelCount() values, i fastest
  std::vector<std::uint8_t> label;       ///< Tissue, in the same order
  std::vector<std::uint8_t> solid;       ///< solid fraction, 0..255
  std::vector<std::uint8_t> tooth;       ///< FDI number of the voxel's tooth, 0 none; empty: no tooth is numbered
};

/// Gives the number `fdi` to every voxel of enamel, dentine and pulp, and 0 to all others.
inline void numberSingleTooth(CtVolume& ct, int fdi) {
  ct.tooth.resize(ct.label.size());
  std::ranges::transform(ct.label, ct.tooth.begin(),
                         [fdi](std::uint8_t label) { return static_cast<std::uint8_t>(isToothPart(label) ? fdi : 0); });
}

/// 1 in the voxels of tooth `fdi`, 0 elsewhere; empty where no voxel has this number.
inline std::vector<std::uint8_t> voxelsOfTooth(const CtVolume& ct, int fdi) {
  if (std::ranges::find(ct.tooth, static_cast<std::uint8_t>(fdi)) == ct.tooth.end()) return {};
  std::vector<std::uint8_t> of_it(ct.tooth.size());
  std::ranges::transform(ct.tooth, of_it.begin(),
                         [fdi](std::uint8_t number) { return static_cast<std::uint8_t>(number == fdi ? 1 : 0); });
  return of_it;
}

}  // namespace assets
