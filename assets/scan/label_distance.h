// The signed distance to a labelled structure, from its voxels: the exact Euclidean distance transform
// (scan/exact_distance) in a box around it, and its surface's voxels beyond. Frame of the grid, mm.
// Any thread but the servo; parallel, about 0.1 µs of CPU a voxel of the box.
#pragma once

#include <cstdint>
#include <span>

#include "assets/structure_distance.h"

namespace assets {

/// Voxels of the largest field: 32 MB in the end, ten times that while it is made. A larger structure has its field
/// around the place of interest.
inline constexpr std::size_t kMostFieldVoxels = std::size_t{1} << 24;

/// `belongs`: not 0 inside, in the order of `grid`; nothing inside: an empty one. `near_P_mm`: where a field is wanted
/// most.
StructureDistance structureDistance(const VolumeGrid& grid, std::span<const std::uint8_t> belongs,
                                    const glm::dvec3& near_P_mm, std::size_t most_voxels = kMostFieldVoxels);

}  // namespace assets
