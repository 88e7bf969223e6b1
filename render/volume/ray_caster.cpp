#include "render/volume/ray_caster.h"

#include <array>

#include "render/gpu/drawing.h"
#include "render/shaders/shared_numbers.glsl"

namespace render {
namespace {

constexpr std::array kLayerTargets{TexelFormat::rgba16f, TexelFormat::r32f};

}  // namespace

void VolumeLayer::fit(glm::ivec2 size) {
  if (target_.size() != size) target_ = Framebuffer(size, kLayerTargets, false);
}

RayCaster::RayCaster(Stage stage, bool skip_empty_space)
    : stage_(stage),
      skips_(skip_empty_space),
      caster_(stage == Stage::compute ? Program("volume.comp") : Program("screen.vert", "volume.frag")) {}

void RayCaster::bind(const VolumeFields& fields, const VolumeTexture& volume, const Frame& frame,
                     const TransferFunction& transfer, bool guided) {
  const int guides =
      !guided ? 0 : (frame.layers.clearance ? GUIDE_CLEARANCE : 0) | (frame.layers.planned_cut ? GUIDE_PLAN : 0);
  const assets::VolumeGrid& grid = fields.grid();
  block_.set(VOLUME_BLOCK,
             {.origin_P = glm::vec4(glm::vec3(grid.origin_P_mm), static_cast<float>(grid.spacing_mm)),
              .size = glm::ivec4(grid.size, skips_ ? 1 : 0),
              .bricks = glm::ivec4(grid.bricks(), frame.mode == ViewMode::dvr ? VIEW_DVR : VIEW_ISO),
              .ambient_size = glm::ivec4(fields.ambient().layout().size, 0),
              .march = {static_cast<float>(frame.quality.step_voxels), frame.quality.ambient_occlusion ? 1.0f : 0.0f,
                        frame.quality.lamp_shadow ? 1.0f : 0.0f, static_cast<float>(guides)}});
  transfer_.set(TRANSFER_BLOCK, transferBlock(transfer));
  volume.bind();
}

void RayCaster::cast(const Framebuffer& layer, const Texture& scene_distance) const {
  scene_distance.bind(SCENE_DISTANCE_UNIT);
  caster_.use();
  if (stage_ == Stage::compute) {
    layer.colour(COLOUR_TARGET).bindForWriting(COLOUR_TARGET);
    layer.colour(DISTANCE_TARGET).bindForWriting(DISTANCE_TARGET);
    dispatch(layer.size(), CAST_GROUP);
  } else {
    layer.bind();
    apply({.depth_test = false, .depth_write = false});
    drawScreen();
  }
}

void RayCaster::draw(VolumeLayer& layer, const Framebuffer& picture) {
  layer.fit(picture.size());
  cast(layer.target(), picture.colour(DISTANCE_TARGET));

  // Light first, wherever there is some; then depth where it is solid.
  layer.target().colour(COLOUR_TARGET).bind(LAYER_LIGHT_UNIT);
  layer.target().colour(DISTANCE_TARGET).bind(LAYER_DISTANCE_UNIT);
  picture.bind();
  apply({.depth_test = false, .depth_write = false, .blend = Blend::premultiplied_over, .write_distance = false});
  light_.use();
  drawScreen();
  apply({.write_colour = false});
  depth_.use();
  drawScreen();
}

}  // namespace render
