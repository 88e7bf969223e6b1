// Solid fraction from grey values: how much of each voxel is hard tissue, 0..255. What is felt, carved and drawn.
//   solid = round(255 Phi((HU - iso) / sigma)), Phi the normal distribution function.
// `solidFromHounsfield` is that formula, voxel by voxel. `classify` widens sigma where the grey values rise so fast
// that the transition would be narrower than a voxel: sigma_eff = max(sigma, |grad HU| s / sqrt(2 pi)), s the voxel's
// edge, which makes the steepest ramp 1 per voxel, the ramp of a flat face's exact partial volume. The iso surface
// (solid = 1/2) stays where HU = iso. Nearly binary fields are the largest error in felt depth and draw jagged
// (reference/physics 0.5). Any thread; runs on all cores (TBB), never on the servo. About 5 ns a voxel and core;
// allocates the result. Throws LoadError for a classification that is no number or has no width.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/patient.h"
#include "assets/volume_grid.h"

namespace assets {

/// Plain: every voxel by itself.
std::vector<std::uint8_t> solidFromHounsfield(const std::vector<std::int16_t>& hounsfield,
                                              const Classification& classification);

/// With a transition at least one voxel wide. `hounsfield` has grid.voxelCount() values.
std::vector<std::uint8_t> classify(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                                   const Classification& classification);

}  // namespace assets
