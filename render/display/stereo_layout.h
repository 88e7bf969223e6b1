// What a pixel of the output shows: which eye, which pixel of it, or black, for every display mode. The CPU compositor
// calls it; shaders/stereo_layout.glsl is its GLSL twin, and tests compare them pixel by pixel. Pixels count from the
// top left of the output, rows downwards. Interleaved modes take the parity of rows and columns from the position on
// the panel, so that it stays when a window moves. Any thread; a few additions. Frame packing: HDMI 1.4a, 3D structure
// "frame packing": 1080p is 1920x2205 with 45 blank lines, 720p 1280x1470 with 30, that is a 24th of the image height;
// other heights use the same fraction.
#pragma once

#include <glm/glm.hpp>

#include "render/display/display_mode.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

/// `both`: the colours of both eyes are mixed, at the same pixel of each.
enum class PixelSource { black = SOURCE_BLACK, left, right, cyclopean, both = SOURCE_BOTH };

struct SourcePixel {
  PixelSource eye = PixelSource::black;
  glm::ivec2 px{0};  ///< in the eye's image, from its top left
  friend constexpr bool operator==(const SourcePixel&, const SourcePixel&) = default;
};

struct StereoLayout {
  DisplayMode mode = DisplayMode::mono;
  glm::ivec2 screen_px{0};  ///< the rig's screen, calibration::ScreenCorners::px
  glm::ivec2 at_px{0};      ///< top left of the output on the panel, px from the panel's top left
  int output = 0;           ///< 0: the only one or the left eye's buffer or window, 1: the right eye's
  bool swapped = false;     ///< the display shows the left image to the right eye
};

/// Number of buffers or windows.
constexpr int outputCount(DisplayMode mode) {
  return mode == DisplayMode::quad_buffer || mode == DisplayMode::two_windows ? 2 : 1;
}

constexpr bool isInterleaved(DisplayMode mode) {
  return mode == DisplayMode::row_interleaved || mode == DisplayMode::column_interleaved ||
         mode == DisplayMode::checkerboard;
}

constexpr bool isAnaglyph(DisplayMode mode) {
  return mode == DisplayMode::anaglyph || mode == DisplayMode::anaglyph_red_cyan;
}

/// Blank lines between the eyes of a packed frame.
constexpr int packingGap_px(int screen_height_px) { return screen_height_px / 24; }

/// Size of each eye's image. In half modes its pixels are twice as wide or high as the panel's.
constexpr glm::ivec2 eyeImageSize(DisplayMode mode, glm::ivec2 screen_px) {
  if (mode == DisplayMode::side_by_side) return {screen_px.x > 1 ? screen_px.x / 2 : 1, screen_px.y};
  if (mode == DisplayMode::top_bottom) return {screen_px.x, screen_px.y > 1 ? screen_px.y / 2 : 1};
  return screen_px;
}

/// Size of each output, that is, of what the graphics card sends.
constexpr glm::ivec2 outputSize(DisplayMode mode, glm::ivec2 screen_px) {
  if (mode == DisplayMode::side_by_side_full) return {2 * screen_px.x, screen_px.y};
  if (mode == DisplayMode::top_bottom_full) return {screen_px.x, 2 * screen_px.y};
  if (mode == DisplayMode::frame_packing) return {screen_px.x, 2 * screen_px.y + packingGap_px(screen_px.y)};
  return screen_px;
}

/// Screen sizes for which HDMI defines frame packing.
constexpr bool isPackable(glm::ivec2 screen_px) {
  return (screen_px.x == 1920 && screen_px.y == 1080) || (screen_px.x == 1280 && screen_px.y == 720);
}

constexpr SourcePixel sourcePixelAt(const StereoLayout& layout, glm::ivec2 px) {
  const glm::ivec2 eye_px = eyeImageSize(layout.mode, layout.screen_px);
  const glm::ivec2 panel{px.x + layout.at_px.x, px.y + layout.at_px.y};
  const auto odd = [](int n) { return (n & 1) != 0; };
  bool second = false;  // the right eye's half
  switch (layout.mode) {
    case DisplayMode::mono:
      return {PixelSource::cyclopean, px};
    case DisplayMode::anaglyph:
    case DisplayMode::anaglyph_red_cyan:
      return {PixelSource::both, px};
    case DisplayMode::quad_buffer:
    case DisplayMode::two_windows:
      second = layout.output == 1;
      break;
    case DisplayMode::side_by_side:
    case DisplayMode::side_by_side_full:
      second = px.x >= eye_px.x;
      if (second) px.x -= eye_px.x;
      break;
    case DisplayMode::top_bottom:
    case DisplayMode::top_bottom_full:
      second = px.y >= eye_px.y;
      if (second) px.y -= eye_px.y;
      break;
    case DisplayMode::frame_packing: {
      const int below_y = eye_px.y + packingGap_px(eye_px.y);
      second = px.y >= below_y;
      if (second) px.y -= below_y;
      break;
    }
    case DisplayMode::row_interleaved:
      second = odd(panel.y);
      break;
    case DisplayMode::column_interleaved:
      second = odd(panel.x);
      break;
    case DisplayMode::checkerboard:
      second = odd(panel.x + panel.y);
      break;
  }
  // Black: the gap of a packed frame, and the last line of a halved odd size.
  if (px.x < 0 || px.y < 0 || px.x >= eye_px.x || px.y >= eye_px.y) return {};
  return {second != layout.swapped ? PixelSource::right : PixelSource::left, px};
}

}  // namespace render
