// The live bone on the GPU: solid fraction (16 bits, so that filtering is not quantised), a smoothed copy for normals,
// tissue labels, the emptiness of its bricks and a coarse ambient map (mean of 2x2x2 voxels) for soft shade.
// The drawn surface is solid = 0.5. Frame P by the grid. Render thread. Update: about 60 us per brick, most of it
// smoothing. Not the bone that is carved (the owner of that copies its bricks here) and not the scan.
#pragma once

#include <cstdint>
#include <span>

#include "assets/volume_grid.h"
#include "render/gpu/texture.h"
#include "render/volume/occupancy.h"

namespace render {

class VolumeTexture {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Throws GpuError if too large.
  VolumeTexture(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                std::span<const std::uint8_t> label);

  /// New content of one brick, i fastest; values outside the volume are ignored. Uploads only that brick.
  void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values);

  /// Before drawing: the emptiness as far as the picture needs it, all of it when nothing was carved since last time.
  void prepare();
  void bind() const;

  const assets::VolumeGrid& grid() const { return grid_; }
  glm::ivec3 ambientCells() const { return ambient_.size(); }

 private:
  void uploadAmbient(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values);
  void uploadSmooth(glm::ivec3 first, glm::ivec3 extent);
  void uploadEmptiness();

  assets::VolumeGrid grid_;
  Occupancy occupancy_;
  Texture solid_, smooth_, label_, emptiness_, ambient_;
  int changes_since_prepare_ = 0;
  int frames_since_rebuild_ = 0;
};

}  // namespace render
