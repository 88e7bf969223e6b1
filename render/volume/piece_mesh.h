// A piece of tooth that can leave the jaw: its live solid fraction and the triangles of its surface solid = 0.5, with
// normals of the smoothed field as the ray-cast surface has them. Frame Q, mm, which is P until it moves; the colours
// are those of the jaw's scan at the same place. Render thread. Construction: 15 to 25 ms of CPU for a molar in 432
// bricks of 0.25 mm voxels. updateBrick() is a copy; prepare() renews the patches and normals of what has changed, and
// puts all triangles together; the frame in which a molar leaves the jaw costs 8 ms more than the next
// (cpu_frame_bench).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/mesh.h"
#include "assets/mesh/bone_surface.h"
#include "render/volume/volume_fields.h"

namespace render {

class PieceMesh {
 public:
  /// `solid` in the order of `grid_Q`. Throws GpuError if it does not fit.
  PieceMesh(const assets::VolumeGrid& grid_Q, std::span<const std::uint8_t> solid);

  /// New content of one brick, i fastest.
  void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid) {
    fields_.updateBrick(brick, solid);
  }
  /// Before drawing. True if model() is another than after the last call; the first time, always.
  bool prepare();

  const assets::MeshModel& model() const { return model_; }
  const VolumeFields& fields() const { return fields_; }

 private:
  void updateNormals(glm::ivec3 brick);
  void putTogether();

  VolumeFields fields_;
  assets::BoneSurface surface_;
  std::vector<std::vector<glm::vec3>> normals_;  ///< by brick, of the vertices of its patch
  assets::MeshModel model_;
  bool is_new_ = true;
};

}  // namespace render
