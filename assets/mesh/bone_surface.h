// Triangle surface of the bone, updated brick by brick during carving. Patches of unchanged bricks are kept; the result
// equals a full rebuild bit for bit. Closed: every edge has two triangles in opposite directions (cube_cases.h).
// Frame P, mm. One thread at a time; parallel inside (TBB), independent of the number of threads. Rebuild: about 3 us a
// brick and core. Update: a changed brick affects itself and the seven before it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assets/mesh.h"
#include "assets/mesh/surface_patch.h"

namespace assets {

class BoneSurface {
 public:
  explicit BoneSurface(const SolidVoxels& solid);

  /// `changed`: bricks with changed voxels. Returns the bricks whose patches were rebuilt, without those that were and
  /// remain empty.
  std::vector<glm::ivec3> update(const SolidVoxels& solid, std::span<const glm::ivec3> changed);

  const VolumeGrid& grid() const { return grid_; }
  /// i fastest.
  std::size_t brickIndex(glm::ivec3 brick) const;
  const SurfacePatch& patch(glm::ivec3 brick) const { return patches_[brickIndex(brick)]; }

  /// All patches as one mesh, each vertex once, in lattice order; area-weighted normals.
  MeshPart mergedMesh(std::string name) const;

 private:
  glm::ivec3 brickOf(std::size_t index) const;

  VolumeGrid grid_;
  std::vector<SurfacePatch> patches_;
};

}  // namespace assets
