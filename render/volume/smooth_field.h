// The solid field smoothed for normals alone: separable binomial 1 4 6 4 1 along each axis (sigma one voxel), air
// outside. The drawn surface stays that of the unsmoothed field. Integers throughout, so a box done later equals a
// volume done at once, bit for bit. One thread per object; about 2 ns a voxel of the box.
#pragma once

#include <cstdint>
#include <vector>

#include "render/volume/bordered_field.h"

namespace render {

/// How far a voxel's value spreads.
inline constexpr int kSmoothReach = 2;

class Smoother {
 public:
  /// Writes the voxels of `box`, which must lie inside the volume: 65535 for solid.
  void smooth(const BorderedField<std::uint8_t>& solid, const VoxelBox& box, BorderedField<std::uint16_t>& smooth);

 private:
  std::vector<std::uint8_t> taken_;               ///< the box with its reach, air outside the volume
  std::vector<std::uint16_t> along_z_, along_y_;  ///< after one and two axes
};

}  // namespace render
