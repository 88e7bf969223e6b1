// Solid fraction from grey values: share of hard tissue in each voxel, 0..255; the field that is felt, carved and
// drawn.
//   solid = round(255 Phi((HU - iso) / sigma)), Phi the normal distribution function.
// `solidFromHounsfield` is that formula. `classify` widens sigma where the transition would be narrower than a voxel:
// sigma_eff = max(sigma, |grad HU| s / sqrt(2 pi)), s the voxel's edge: the steepest ramp is then 1 per voxel, as a
// flat face's exact partial volume. The iso surface (solid = 1/2) stays at HU = iso. Nearly binary fields are the
// largest error in felt depth and draw jagged (reference/physics 0.5). Any thread; parallel (TBB), never on the servo.
// About 5 ns a voxel and core; allocates the result. Throws LoadError unless iso and sigma are finite and sigma above
// 0.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/patient.h"
#include "assets/volume_grid.h"

namespace assets {

/// Each voxel by itself.
std::vector<std::uint8_t> solidFromHounsfield(const std::vector<std::int16_t>& hounsfield,
                                              const Classification& classification);

/// Transition at least one voxel wide. `hounsfield` has grid.voxelCount() values.
std::vector<std::uint8_t> classify(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                                   const Classification& classification);

}  // namespace assets
