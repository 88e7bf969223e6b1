// Tooth and bone as triangles: the surface of assets/bone_surface on the GPU, by brick, shaded as the ray-cast surface.
// Frame P. Render thread. First frame: all bricks (50 ms for 4 million voxels); then about 80 us a carved brick.
// The caster's volume must be bound while drawing. Differs slightly from the ray-cast surface: triangles are flat
// within a voxel, where the trilinear field is curved.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "assets/mesh/bone_surface.h"
#include "render/gpu/program.h"
#include "render/gpu/triangle_pool.h"
#include "render/volume/volume_fields.h"

namespace render {

class BoneMesh {
 public:
  /// Records the changes of the volume; required in every view mode.
  void markChanged(const FieldChanges& changes);
  /// Before drawing: updates the triangles of all changed bricks.
  void prepare(const VolumeFields& fields);
  void draw(bool view_is_mirrored);

 private:
  void upload(glm::ivec3 brick);

  Program depth_{"bone_mesh.vert", "bone_depth.frag"}, light_{"bone_mesh.vert", "bone_mesh.frag"};
  std::optional<assets::BoneSurface> surface_;
  std::optional<TrianglePool> pool_;
  std::vector<glm::ivec3> changed_;  ///< bricks, possibly repeated
};

}  // namespace render
