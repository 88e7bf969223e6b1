// A head of soft tissue with two dental arches, for benchmarks: a cube of 102.4 mm of Hounsfield units, of any number
// of voxels. Skin, trabecular bone in a cortical shell, the branches of the jaw, and teeth of dentine, enamel and pulp
// in some noise: about a sixth of the bricks of 8x8x8 voxels hold a surface. The same for every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace bench {

inline constexpr double kHead_mm = 102.4;

assets::VolumeGrid headGrid(int voxels_along_edge);
std::vector<std::int16_t> syntheticHead(const assets::VolumeGrid& grid);

/// Where its surface is drawn.
inline constexpr double kSurface_HU = 500.0;
/// Linear, one half at the surface and all of it 1000 HU above.
std::uint8_t solidOf(int hounsfield);

/// The DVR's opacity of one voxel's length, as reference/rendering 2 has it: 0.6 at 900 HU, all of it from 1400 HU on.
inline constexpr double kHalfway_HU = 900.0, kHalfway = 0.6, kOpaqueFrom_HU = 1400.0, kOpaque = 0.9999;
double opacityPerVoxel(double hounsfield);

/// Where the bur of radius 2 mm is in a frame: along a groove on the outside of the lower jaw.
glm::dvec3 burCentre_mm(int frame);
inline constexpr double kBur_mm = 2.0;

}  // namespace bench
