// Casts one ray per pixel into the volume, surface (solid = 0.5) or translucent, and blends the result over an eye's
// image with depth and distance. Fragment or compute program, built from one body (volume_pixel.glsl). Rays end at the
// distance already in the image, so meshes drawn before are respected. Frame P. Render thread. Sample positions do not
// depend on empty-space skipping: the image is bit-identical with and without. Cost: on a software rasteriser about 0.2
// s CPU at 640x480.
#pragma once

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
  glm::ivec4 paint_low{0}, paint_size{0};
};
static_assert(sizeof(VolumeBlock) == 112);

class RayCaster {
 public:
  enum class Stage { fragment, compute };

  RayCaster(Stage stage, bool skip_empty_space);

  /// Binds volume, block and transfer function. Required by every pass that reads the volume.
  void bind(const VolumeFields& fields, const VolumeTexture& volume, const Frame& frame);
  /// After bind(): casts into `layer`, resized to fit, and blends it over `image` (colour, distance,
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
