#include "render/display/stereo_compositor.h"

#include "render/gpu/drawing.h"
#include "render/shaders/shared_numbers.glsl"

namespace render {

glm::ivec2 eyePictureSize(DisplayMode mode, glm::ivec2 output) {
  switch (mode) {
    case DisplayMode::side_by_side:
      return {glm::max(output.x / 2, 1), output.y};
    case DisplayMode::top_bottom:
      return {output.x, glm::max(output.y / 2, 1)};
    case DisplayMode::mono:
    case DisplayMode::anaglyph:
      break;
  }
  return output;
}

StereoCompositor::StereoCompositor() : program_("screen.vert", "output.frag") {}

void StereoCompositor::compose(DisplayMode mode, const Texture& left, const Texture& right, int samples,
                               const Framebuffer& output) {
  output.bind();
  apply({.depth_test = false, .depth_write = false});
  program_.use();
  const glm::ivec2 size = eyePictureSize(mode, output.size());
  switch (mode) {
    case DisplayMode::mono:
      show(OUTPUT_LEFT, left, left, samples, {0, 0}, size);
      break;
    case DisplayMode::anaglyph:
      show(OUTPUT_ANAGLYPH, left, right, samples, {0, 0}, size);
      break;
    case DisplayMode::side_by_side:
      show(OUTPUT_LEFT, left, left, samples, {0, 0}, size);
      show(OUTPUT_LEFT, right, right, samples, {size.x, 0}, size);
      break;
    case DisplayMode::top_bottom:
      show(OUTPUT_LEFT, right, right, samples, {0, 0}, size);
      show(OUTPUT_LEFT, left, left, samples, {0, size.y}, size);
      break;
  }
}

void StereoCompositor::show(int mode, const Texture& left, const Texture& right, int samples, glm::ivec2 corner,
                            glm::ivec2 size) {
  left.bind(LEFT_EYE_UNIT);
  right.bind(RIGHT_EYE_UNIT);
  block_.set(OUTPUT_BLOCK, {.mode = {mode, samples, 0, 0}, .corner = {corner, 0, 0}});
  setViewport(corner, size);
  drawScreen();
}

}  // namespace render
