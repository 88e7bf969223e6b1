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

/// How translucent it is in the DVR: nothing at the surface's value, nearly opaque over a millimetre from 500 HU above.
/// About the curve of reference/rendering 2 (0.6 per voxel of 0.4 mm at 900 HU).
inline constexpr double kOpaqueFrom_HU = 1000.0, kOpacity_per_mm = 0.99;

/// Where the bur of radius 2 mm is in a frame: along a groove on the outside of the lower jaw.
glm::dvec3 burCentre_mm(int frame);
inline constexpr double kBur_mm = 2.0;

}  // namespace bench
