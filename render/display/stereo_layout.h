// What an output's pixel shows: which eye, which pixel of it, or black. The one answer for every display mode; the
// output pass in GLSL (shaders/stereo_layout.glsl) and the compositor without OpenGL follow it, and tests compare them
// pixel by pixel. Pixels count from the top left of the output, whose rows run downwards. Interleaved displays hold
// their rows and columns still while windows move: parity follows the place on the panel. Any thread; a few additions.
// Frame packing: HDMI 1.4a, 3D structure "frame packing": 1080p is 1920x2205 with 45 blank lines, 720p 1280x1470 with
// 30: a 24th of the image's height, which other heights are given as well.
#pragma once

#include <glm/glm.hpp>

#include "render/display/display_mode.h"

namespace render {

/// `both`: the colours of the eyes are mixed, at the same pixel of each.
enum class PixelSource { black, left, right, cyclopean, both };

struct SourcePixel {
  PixelSource eye = PixelSource::black;
  glm::ivec2 px{0};  ///< in the eye's image, from its top left
  friend constexpr bool operator==(const SourcePixel&, const SourcePixel&) = default;
};

struct StereoLayout {
  DisplayMode mode = DisplayMode::mono;
  glm::ivec2 screen_px{0};  ///< the rig's screen, calibration::ScreenCorners::px
  glm::ivec2 at_px{0};      ///< top left of the output on the panel, px from the panel's top left
  int output = 0;           ///< of outputCount: the left eye's buffer or window is 0, the right eye's 1
  bool swapped = false;     ///< the display shows the left eye what is meant for the right one
};

/// Buffers or windows that are filled.
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

/// Each eye's image. Of a half mode its pixels are twice as wide or high as the panel's.
constexpr glm::ivec2 eyeImageSize(DisplayMode mode, glm::ivec2 screen_px) {
  if (mode == DisplayMode::side_by_side) return {screen_px.x > 1 ? screen_px.x / 2 : 1, screen_px.y};
  if (mode == DisplayMode::top_bottom) return {screen_px.x, screen_px.y > 1 ? screen_px.y / 2 : 1};
  return screen_px;
}

/// Each output, that is, what the graphics card sends.
constexpr glm::ivec2 outputSize(DisplayMode mode, glm::ivec2 screen_px) {
  if (mode == DisplayMode::side_by_side_full) return {2 * screen_px.x, screen_px.y};
  if (mode == DisplayMode::top_bottom_full) return {screen_px.x, 2 * screen_px.y};
  if (mode == DisplayMode::frame_packing) return {screen_px.x, 2 * screen_px.y + packingGap_px(screen_px.y)};
  return screen_px;
}

/// The display a frame-packed signal can be sent to has one of these screens.
constexpr bool isPackable(glm::ivec2 screen_px) {
  return (screen_px.x == 1920 && screen_px.y == 1080) || (screen_px.x == 1280 && screen_px.y == 720);
}

constexpr SourcePixel sourcePixelAt(const StereoLayout& layout, glm::ivec2 px) {
  const glm::ivec2 eye_px = eyeImageSize(layout.mode, layout.screen_px);
  const glm::ivec2 place{px.x + layout.at_px.x, px.y + layout.at_px.y};
  const auto odd = [](int n) { return (n & 1) != 0; };
  bool second = false;  // the right eye's place
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
      second = odd(place.y);
      break;
    case DisplayMode::column_interleaved:
      second = odd(place.x);
      break;
    case DisplayMode::checkerboard:
      second = odd(place.x + place.y);
      break;
  }
  // The gap of a packed frame, and the last line of an odd size that was halved.
  if (px.x < 0 || px.y < 0 || px.x >= eye_px.x || px.y >= eye_px.y) return {};
  return {second != layout.swapped ? PixelSource::right : PixelSource::left, px};
}

}  // namespace render
