#include "render/volume/ray_caster.h"

#include "render/gpu/drawing.h"
#include "render/shaders/shared_numbers.glsl"

namespace render {

RayCaster::RayCaster(EmptySpace empty_space) : empty_space_(empty_space), program_("screen.vert", "volume.frag") {}

void RayCaster::bind(const VolumeFields& fields, const VolumeTexture& volume) {
  const assets::VolumeGrid& grid = fields.grid();
  block_.set(VOLUME_BLOCK, {.origin_P = glm::vec4(glm::vec3(grid.origin_P_mm), static_cast<float>(grid.spacing_mm)),
                            .size = glm::ivec4(grid.size, empty_space_ == EmptySpace::skip ? 1 : 0),
                            .bricks = glm::ivec4(grid.bricks(), 0),
                            .ambient_size = glm::ivec4(fields.ambient().layout().size, 0)});
  volume.bind();
}

void RayCaster::draw(const Texture& scene_distance) {
  scene_distance.bind(SCENE_DISTANCE_UNIT);
  finishWritesBeforeReads();
  apply({.depth_test = true, .depth_write = true});
  program_.use();
  drawScreen();
}

}  // namespace render
