// Draws the surface solid = 0.5 of a volume by one ray per pixel, with depth and distance, into the bound eye target.
// Rays end at what the target's distance already holds, so meshes drawn before are respected. Frame P. Render thread.
// Sampling places do not depend on empty-space skipping: with and without it the picture is the same, bit for bit.
// Cost: on a GPU see reference figures in render/README.md; on a software rasteriser about 0.5 s CPU at 640x480.
#pragma once

#include "render/gpu/buffer.h"
#include "render/gpu/program.h"
#include "render/volume/volume_texture.h"

namespace render {

/// std140 twin of volume_block.glsl.
struct VolumeBlock {
  glm::vec4 origin_P;
  glm::ivec4 size{0}, bricks{0}, ambient_size{0};
};
static_assert(sizeof(VolumeBlock) == 64);

class RayCaster {
 public:
  enum class EmptySpace { skip, march };

  explicit RayCaster(EmptySpace empty_space = EmptySpace::skip);

  /// Binds volume and block; passes that ask the volume for shade need this before drawing.
  void bind(const VolumeFields& fields, const VolumeTexture& volume);
  /// `scene_distance`: the distance attachment being drawn into. After bind().
  void draw(const Texture& scene_distance);

 private:
  EmptySpace empty_space_;
  Program program_;
  UniformBlock<VolumeBlock> block_;
};

}  // namespace render
