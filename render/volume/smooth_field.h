// The solid field smoothed for normals alone: separable binomial 1 4 6 4 1 along each axis (sigma one voxel), air
// outside. The drawn surface stays that of the unsmoothed field. Integers throughout, so a brick done later equals a
// volume done at once, bit for bit. Any thread; allocates only the result; about 50 us for a brick with its border.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"

namespace render {

/// How far a voxel's value spreads.
inline constexpr int kSmoothReach = 2;

/// The voxels `first` … `first + extent - 1`, i fastest, 65535 for solid. The box must lie inside the volume.
std::vector<std::uint16_t> smoothed(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                    glm::ivec3 first, glm::ivec3 extent);

}  // namespace render
