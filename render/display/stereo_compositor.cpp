#include "render/display/stereo_compositor.h"

#include "render/gpu/drawing.h"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

static_assert(static_cast<int>(DisplayMode::mono) == DISPLAY_MONO &&
              static_cast<int>(DisplayMode::quad_buffer) == DISPLAY_QUAD_BUFFER &&
              static_cast<int>(DisplayMode::two_windows) == DISPLAY_TWO_WINDOWS &&
              static_cast<int>(DisplayMode::side_by_side) == DISPLAY_SIDE_BY_SIDE &&
              static_cast<int>(DisplayMode::side_by_side_full) == DISPLAY_SIDE_BY_SIDE_FULL &&
              static_cast<int>(DisplayMode::top_bottom) == DISPLAY_TOP_BOTTOM &&
              static_cast<int>(DisplayMode::top_bottom_full) == DISPLAY_TOP_BOTTOM_FULL &&
              static_cast<int>(DisplayMode::frame_packing) == DISPLAY_FRAME_PACKING &&
              static_cast<int>(DisplayMode::row_interleaved) == DISPLAY_ROW_INTERLEAVED &&
              static_cast<int>(DisplayMode::column_interleaved) == DISPLAY_COLUMN_INTERLEAVED &&
              static_cast<int>(DisplayMode::checkerboard) == DISPLAY_CHECKERBOARD &&
              static_cast<int>(DisplayMode::anaglyph) == DISPLAY_ANAGLYPH &&
              static_cast<int>(DisplayMode::anaglyph_red_cyan) == DISPLAY_ANAGLYPH_RED_CYAN);

}  // namespace

void StereoCompositor::compose(const StereoLayout& layout, const Texture& left, const Texture& right, int samples,
                               const Framebuffer& output) {
  output.bind();
  left.bind(LEFT_EYE_UNIT);
  right.bind(RIGHT_EYE_UNIT);
  block_.set(OUTPUT_BLOCK,
             {.mode = {static_cast<int>(layout.mode), samples, layout.output, layout.swapped ? 1 : 0},
              .place = {layout.at_px, output.size()},
              .eye = {eyeImageSize(layout.mode, layout.screen_px), packingGap_px(layout.screen_px.y), 0}});
  drawScreen(program_, {.depth_test = false, .depth_write = false});
}

}  // namespace render
