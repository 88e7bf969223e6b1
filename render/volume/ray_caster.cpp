#include "render/volume/ray_caster.h"

#include <array>

#include "render/gpu/drawing.h"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

constexpr std::array kLayerTargets{TexelFormat::rgba16f, TexelFormat::r32f};

}  // namespace

RayCaster::RayCaster(Stage stage, bool skip_empty_space)
    : stage_(stage),
      skips_(skip_empty_space),
      caster_(stage == Stage::compute ? Program{"volume.comp"} : Program{"screen.vert", "volume.frag"}) {}

void RayCaster::bind(const VolumeFields& fields, const VolumeTexture& volume, const Frame& frame) {
  const int guides = volume.hasGuides() ? visibleGuides(frame) : 0;
  const bool is_painted = frame.paint != nullptr && volume.paintSize().x > 0;
  const assets::VolumeGrid& grid = fields.grid();
  block_.set(VOLUME_BLOCK,
             {.origin_P = glm::vec4(glm::vec3(grid.origin_P_mm), static_cast<float>(grid.spacing_mm)),
              .size = glm::ivec4(grid.size, skips_ ? 1 : 0),
              .bricks = glm::ivec4(grid.bricks(), isTranslucent(frame.mode) ? VIEW_DVR : VIEW_ISO),
              .ambient_size = glm::ivec4(fields.ambient().layout().size, 0),
              .march = {static_cast<float>(frame.quality.step_voxels), frame.quality.ambient_occlusion ? 1.0f : 0.0f,
                        frame.quality.lamp_shadow ? 1.0f : 0.0f, static_cast<float>(guides)},
              .paint_low = glm::ivec4(volume.paintLow(), 0),
              .paint_size = glm::ivec4(volume.paintSize(), is_painted ? 1 : 0)});
  transfer_.set(TRANSFER_BLOCK, transferBlock(transferOf(frame.mode)));
  volume.bind();
}

void RayCaster::cast(const Framebuffer& layer, const Texture& scene_distance) const {
  scene_distance.bind(SCENE_DISTANCE_UNIT);
  if (stage_ == Stage::compute) {
    caster_.use();
    layer.colour(COLOUR_TARGET).bindForWriting(COLOUR_TARGET);
    layer.colour(DISTANCE_TARGET).bindForWriting(DISTANCE_TARGET);
    dispatch(layer.size(), CAST_GROUP);
  } else {
    layer.bind();
    drawScreen(caster_, {.depth_test = false, .depth_write = false});
  }
}

void RayCaster::draw(Framebuffer& layer, const Framebuffer& image) {
  layer.fit(image.size(), kLayerTargets, false);
  cast(layer, image.colour(DISTANCE_TARGET));

  // Light first; then depth where it is solid.
  layer.colour(COLOUR_TARGET).bind(LAYER_LIGHT_UNIT);
  layer.colour(DISTANCE_TARGET).bind(LAYER_DISTANCE_UNIT);
  image.bind();
  drawScreen(light_, {.depth_test = false, .depth_write = false, .blend = true, .write_distance = false});
  drawScreen(depth_, {.write_colour = false});
}

}  // namespace render
