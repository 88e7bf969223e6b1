// The surface solid = 0.5 inside one brick of a volume, as triangles: marching cubes over the brick's cells. A cell
// lies between eight voxels and belongs to the brick of its lowest one; cells that begin in the air before the volume
// belong to its first bricks. So the patches of all bricks part solid from air completely, air being all around. A
// vertex lies where the trilinear field crosses 0.5 on an edge of the lattice; 127.5 of 255 is no voxel's value, so it
// never falls on a voxel. Patches that meet have bit-equal vertices there. Frame P, mm; triangles counter-clockwise
// seen from the air. Any thread; about 10 us for a brick with surface, 1 us without. Not the whole surface
// (bone_surface), and without normals: those come from the field, or from all patches together.
#pragma once

#include <vector>

#include "assets/solid_voxels.h"

namespace assets {

struct SurfacePatch {
  std::vector<glm::vec3> position_P_mm;
  std::vector<std::uint64_t> lattice_edge;  ///< per vertex: a number of its edge, the same in every patch
  std::vector<std::uint32_t> triangles;     ///< three indices each

  bool empty() const { return triangles.empty(); }
};

SurfacePatch surfacePatch(const SolidVoxels& solid, glm::ivec3 brick);

}  // namespace assets
