// Casts one ray per pixel into a volume and lays what it meets over an eye's image, with depth and distance, as a
// fragment or as a compute program built from one body (volume_pixel.glsl). Surface solid = 0.5 or translucent.
// Rays end at what the image's distance already holds, so meshes drawn before are respected. Frame P. Render thread.
// Sampling places do not depend on empty-space skipping: with and without it the image is the same, bit for bit.
// Cost: figures in render/README.md; on a software rasteriser about 0.2 s CPU at 640x480.
#pragma once

#include <optional>

#include "render/frame.h"
#include "render/gpu/buffer.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"
#include "render/volume/transfer_function.h"
#include "render/volume/volume_texture.h"

namespace render {

/// std140 twin of volume_block.glsl.
struct VolumeBlock {
  glm::vec4 origin_P;
  glm::ivec4 size{0}, bricks{0}, ambient_size{0};
  glm::vec4 march{0.0f};
};
static_assert(sizeof(VolumeBlock) == 80);

class RayCaster {
 public:
  enum class Stage { fragment, compute };

  RayCaster(Stage stage, bool skip_empty_space);

  /// Binds volume, block and transfer function. Passes that ask the volume for shade need this before drawing.
  void bind(const VolumeFields& fields, const VolumeTexture& volume, const Frame& frame);
  /// After bind(): casts into `layer`, made as large as it must be, and lays it over `image` (colour, distance,
  /// depth).
  void draw(Framebuffer& layer, const Framebuffer& image);

 private:
  void cast(const Framebuffer& layer, const Texture& scene_distance) const;

  Stage stage_;
  bool skips_;
  Program caster_;
  Program light_{"screen.vert", "layer_light.frag"}, depth_{"screen.vert", "layer_depth.frag"};
  UniformBlock<VolumeBlock> block_;
  UniformBlock<TransferBlock> transfer_;
};

}  // namespace render
