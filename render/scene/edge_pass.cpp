#include "render/scene/edge_pass.h"

#include <array>

#include "render/gpu/drawing.h"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

constexpr std::array kMaskTargets{TexelFormat::r8ui};

}  // namespace

void EdgePass::find(const Framebuffer& image) {
  mask_.fit(image.size(), kMaskTargets, false);
  image.colour(COLOUR_TARGET).bind(LAYER_LIGHT_UNIT);
  image.colour(DISTANCE_TARGET).bind(SCENE_DISTANCE_UNIT);
  mask_.bind();
  drawScreen(find_, {.depth_test = false, .depth_write = false});
}

void EdgePass::rejectInterior(const Framebuffer& samples) {
  mask_.colour(0).bind(EDGE_MASK_UNIT);
  samples.bind();
  drawScreen(reject_, {.write_colour = false});
}

void EdgePass::average(const Framebuffer& samples, const Framebuffer& image) {
  mask_.colour(0).bind(EDGE_MASK_UNIT);
  samples.colour(COLOUR_TARGET).bind(LAYER_LIGHT_UNIT);
  image.bind();
  drawScreen(average_, {.depth_test = false, .depth_write = false, .write_distance = false});
}

}  // namespace render
