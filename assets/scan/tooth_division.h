// Divides a volume into the jaw and one tooth, so that the tooth can leave the jaw. The solid fractions of both add up
// to the volume's in every voxel. Where tooth and bone meet, both fade over two voxels instead of ending in steps:
//   tooth = solid share,  share = sum of w h solid over voxels of the tooth / the same over all voxels,
// w binomial 1 2 1 along each axis (the 27 voxels around), h = 50 for hard labels, 1 for others. A voxel of both has in
// each volume the label that weighs most there. Integers alone: the same bytes on every machine. Any thread; about 50
// ns a voxel of the tooth's box; allocates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// Solid fraction and labels in the order of `grid`; no labels: unlabelled.
struct BodyVolume {
  VolumeGrid grid;
  std::vector<std::uint8_t> solid, label;
};

struct ToothDivision {
  BodyVolume jaw;    ///< on the volume's grid
  BodyVolume tooth;  ///< whole bricks of that grid around the tooth, perhaps beyond its end; no voxels: no tooth
  glm::ivec3 first_brick{0};  ///< brick of the jaw's grid at the start of the tooth's
};

/// `is_tooth` is not 0 in the voxels of the tooth; empty: there is none. Spans that do not fit the grid are a bug of
/// the caller (assert).
ToothDivision divideByTooth(const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                            std::span<const std::uint8_t> label, std::span<const std::uint8_t> is_tooth);

}  // namespace assets
