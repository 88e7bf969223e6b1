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

/// Linear, 700 HU becomes one half.
std::uint8_t solidOf(int hounsfield);

/// Where the bur of radius 2 mm is in a frame: along a groove on the outside of the lower jaw.
glm::dvec3 burCentre_mm(int frame);
inline constexpr double kBur_mm = 2.0;

}  // namespace bench
