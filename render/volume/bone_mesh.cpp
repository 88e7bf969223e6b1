#include "render/volume/bone_mesh.h"

#include "render/gpu/drawing.h"

namespace render {

void BoneMesh::markChanged(const FieldChanges& changes) {
  if (!surface_) return;
  for (const VoxelBox& box : changes.solid) {
    const glm::ivec3 first = box.first / assets::kBrickVoxels;
    forEachIn({first, (box.first + box.extent - 1) / assets::kBrickVoxels + 1 - first},
              [this](glm::ivec3 brick) { changed_.push_back(brick); });
  }
}

void BoneMesh::prepare(const VolumeFields& fields) {
  if (surface_) {
    if (changed_.empty()) return;
    for (const glm::ivec3& brick : surface_->update(fields.voxels(), changed_)) upload(brick);
    changed_.clear();
    return;
  }
  surface_.emplace(fields.voxels());
  const VoxelBox bricks{glm::ivec3(0), fields.grid().bricks()};
  std::size_t vertices = 0, indices = 0;
  forEachIn(bricks, [&](glm::ivec3 brick) {
    vertices += surface_->patch(brick).position_P_mm.size();
    indices += surface_->patch(brick).triangles.size();
  });
  pool_.emplace(bricks.count(), 3 * vertices / 2, 3 * indices / 2);
  forEachIn(bricks, [&](glm::ivec3 brick) {
    if (!surface_->patch(brick).empty()) upload(brick);
  });
}

void BoneMesh::upload(glm::ivec3 brick) {
  const assets::SurfacePatch& patch = surface_->patch(brick);
  pool_->set(surface_->brickIndex(brick), patch.position_P_mm, patch.triangles);
}

void BoneMesh::draw(bool view_is_mirrored) {
  // Depth first, since cancellous bone has many layers and shading is expensive.
  apply({.mirrored = view_is_mirrored, .write_colour = false, .write_distance = false});
  depth_.use();
  pool_->draw();
  apply({.depth_write = false, .allow_equal_depth = true, .mirrored = view_is_mirrored});
  light_.use();
  pool_->draw();
}

}  // namespace render
