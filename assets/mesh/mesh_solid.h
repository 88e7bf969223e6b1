// What a closed mesh encloses, as the solid fraction of a grid's voxels: nine rays a voxel along x, each exact along
// its way. Rays and edges are compared in one order, so that a closed mesh is met an even number of times, whatever
// lies on an edge. Frame of the mesh, mm. Any thread; some 0.2 s for 10^5 triangles on a molar's crown of 0.08 mm.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/mesh/stl_read.h"
#include "assets/volume_grid.h"

namespace assets {

/// Edges that do not belong to two faces, one each way; 0: closed. Corners at one place are one.
std::size_t openEdges(std::span<const StlTriangle> mesh);

/// 0..255, i fastest; of a closed mesh, whichever way its faces look. Throws LoadError: faces so large and so many that
/// no tooth has them.
std::vector<std::uint8_t> solidOfMesh(std::span<const StlTriangle> mesh, const VolumeGrid& grid);

}  // namespace assets
