#include "render/display/stereo_compositor.h"

#include "render/gpu/drawing.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

void StereoCompositor::compose(const StereoLayout& layout, const Texture& left, const Texture& right, int samples,
                               const Framebuffer& output) {
  output.bind();
  left.bind(LEFT_EYE_UNIT);
  right.bind(RIGHT_EYE_UNIT);
  block_.set(OUTPUT_BLOCK,
             {.mode = {static_cast<int>(layout.mode), samples, layout.output, layout.swapped ? 1 : 0},
              .output_px = {layout.at_px, output.size()},
              .eye = {eyeImageSize(layout.mode, layout.screen_px), packingGap_px(layout.screen_px.y), 0}});
  drawScreen(program_, {.depth_test = false, .depth_write = false});
}

}  // namespace render
