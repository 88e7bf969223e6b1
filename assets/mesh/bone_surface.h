// The surface of the bone as triangles, brick by brick, kept up to date while it is carved. Patches of bricks that did
// not change stay as they are; the result is that of making all anew, bit for bit.
// Frame P, mm. One thread at a time; parallel inside (TBB), the result does not depend on the number of threads.
// Making all: about 3 us a brick and core. Update: a changed brick touches itself and the seven before it.
// Closed: every edge has two triangles that walk it in opposite directions (cube_cases.h says why).
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

  /// `changed`: bricks of voxels that are no longer as they were. Returns the bricks whose patches were made anew, but
  /// for those that had and have no triangles.
  std::vector<glm::ivec3> update(const SolidVoxels& solid, std::span<const glm::ivec3> changed);

  const VolumeGrid& grid() const { return grid_; }
  /// Bricks are numbered i fastest.
  std::size_t brickIndex(glm::ivec3 brick) const;
  const SurfacePatch& patch(glm::ivec3 brick) const { return patches_[brickIndex(brick)]; }
  std::size_t triangleCount() const;

  /// All patches as one mesh, each vertex once, in the order of the lattice; normals weighted by area.
  MeshPart mergedMesh(std::string name) const;

 private:
  glm::ivec3 brickOf(std::size_t index) const;

  VolumeGrid grid_;
  std::vector<SurfacePatch> patches_;
};

}  // namespace assets
