// Surface solid = 0.5 within one brick, as triangles: marching cubes over the brick's cells. A cell spans eight voxels
// and belongs to the brick of its lowest one; cells that begin in the air before the volume belong to the first bricks,
// so all patches together separate solid from air completely. A vertex lies where the trilinear field crosses 0.5 on a
// lattice edge; 127.5 of 255 is no voxel value, so never on a voxel. Adjacent patches have bit-equal vertices on their
// border. Frame P, mm; triangles counter-clockwise seen from the air, without normals. Any thread; about 10 us with
// surface, 1 us without.
#pragma once

#include <vector>

#include "assets/solid_voxels.h"

namespace assets {

struct SurfacePatch {
  std::vector<glm::vec3> position_P_mm;
  std::vector<std::uint64_t> lattice_edge;  ///< per vertex: index of its lattice edge, the same in all patches
  std::vector<std::uint32_t> triangles;     ///< three indices each

  bool empty() const { return triangles.empty(); }
};

SurfacePatch surfacePatch(const SolidVoxels& solid, glm::ivec3 brick);

}  // namespace assets
