// Tissue and solid fraction of a tooth's voxels by their density. A voxel on a level, away from air, has that level's
// tissue. At the outside a value between is a share of the tissue beneath: 100 there is two thirds of dentine and no
// pulp. A file of nothing but levels has no partial voxels: pulp at its outside is an open foramen, and the surface is
// drawn over three voxels, so that it is felt and seen smooth. Pulp is soft: not solid. Any thread; 30 ns a voxel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/import/tooth_volume.h"
#include "assets/volume_grid.h"

namespace assets {

/// So near to a level a value is that level.
inline constexpr int kOnLevel = 8;

struct DensityTissue {
  std::vector<std::uint8_t> label, solid;  ///< of the largest piece; all else is air
  double largest_share = 0.0;              ///< of all that is no air
};

/// The outermost voxels must be air.
DensityTissue densityTissue(const VolumeGrid& grid, std::span<const std::uint8_t> density, const ToothLevels& levels);

}  // namespace assets
