// The solid field smoothed, for normals only: separable binomial 1 4 6 4 1 along each axis (sigma one voxel), air
// outside. Integer arithmetic, so a box updated later equals a full computation bit for bit. One thread per object;
// about 2 ns a voxel of the box.
#pragma once

#include <cstdint>
#include <vector>

#include "render/volume/bordered_field.h"

namespace render {

/// Radius of the filter, voxels.
inline constexpr int kSmoothReach = 2;

class Smoother {
 public:
  /// Writes the voxels of `box`, which must be inside the volume; 65535 for solid.
  void smooth(const BorderedField<std::uint8_t>& solid, const VoxelBox& box, BorderedField<std::uint16_t>& smooth);

 private:
  std::vector<std::uint8_t> taken_;               ///< the box and its border, air outside the volume
  std::vector<std::uint16_t> along_z_, along_y_;  ///< after one and two axes
};

}  // namespace render
