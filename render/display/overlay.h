// Small pictures in the plane of the (virtual) screen, over the composed image: text and bars that both eyes see at the
// same place (no disparity), upright for the viewer through every panel and mirror, undistorted in half modes. Here
// they become patches in the pixels of an output, the same for every back-end, which only blends them. Pure; any
// thread; proportional to the panel's area, about 1 ns a pixel.
//
// Interleaved displays give each eye every second line: there a panel is filtered [1 2 1]/4 across the lines, so that
// no stroke of a letter is seen by one eye alone. Anaglyphs mix the panel's colours as they mix the scene's.
#pragma once

#include <cstdint>
#include <vector>

#include "render/display/screen_orientation.h"
#include "render/display/stereo_layout.h"

namespace render {

struct OverlayPanel {
  Image image;               ///< upright; sRGB, premultiplied by its alpha; a pixel is one of the screen
  glm::ivec2 corner_px{0};   ///< viewer's pixels of the screen
  std::uint64_t serial = 0;  ///< another number for every other content or place
};

/// The part of a panel that lies on the screen, as an output shows it.
struct OverlayPatch {
  Image image;                         ///< sRGB, premultiplied
  std::vector<glm::ivec2> corners_px;  ///< from the output's top left: once, or once for each eye
  std::uint64_t serial = 0;            ///< another number for every other content
};

OverlayPatch patchOf(const OverlayPanel& panel, const StereoLayout& layout, const ScreenOrientation& orientation);

/// Top left of each eye's area in an output.
std::vector<glm::ivec2> eyeAreas(const StereoLayout& layout);

}  // namespace render
