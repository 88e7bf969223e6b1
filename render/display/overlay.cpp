#include "render/display/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/display/anaglyph.h"
#include "render/display/srgb.h"

namespace render {
namespace {

std::size_t byteAt(const Image& image, int x, int y) { return 4 * static_cast<std::size_t>(y * image.w + x); }

/// The part inside a box of its pixels.
Image cropped(const Image& image, const PixelBox& box) {
  if (box.corner_px == glm::ivec2(0) && box.size_px == glm::ivec2(image.w, image.h)) return image;
  Image part{box.size_px.x, box.size_px.y, {}};
  for (int y = 0; y < part.h; ++y) {
    const auto row =
        image.rgba.begin() + static_cast<std::ptrdiff_t>(byteAt(image, box.corner_px.x, box.corner_px.y + y));
    part.rgba.insert(part.rgba.end(), row, row + 4 * part.w);
  }
  return part;
}

/// Each pixel the mean of those of the finer image, whose first pixel has the offset `first` in the grid of means.
Image averaged(const Image& fine, glm::ivec2 first, glm::ivec2 by) {
  if (by == glm::ivec2(1)) return fine;
  const glm::ivec2 end = first + glm::ivec2(fine.w, fine.h);
  const glm::ivec2 low = first / by, high = (end + by - 1) / by;
  Image coarse{high.x - low.x, high.y - low.y, {}};
  coarse.rgba.resize(4 * static_cast<std::size_t>(coarse.w) * static_cast<std::size_t>(coarse.h));
  const int count = by.x * by.y;
  for (int y = 0; y < coarse.h; ++y)
    for (int x = 0; x < coarse.w; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        int sum = 0;
        for (int j = 0; j < by.y; ++j)
          for (int i = 0; i < by.x; ++i) {
            const glm::ivec2 at = (low + glm::ivec2(x, y)) * by + glm::ivec2(i, j) - first;
            if (at.x >= 0 && at.y >= 0 && at.x < fine.w && at.y < fine.h)
              sum += fine.rgba[byteAt(fine, at.x, at.y) + c];
          }
        coarse.rgba[byteAt(coarse, x, y) + c] = static_cast<std::uint8_t>((2 * sum + count) / (2 * count));
      }
  return coarse;
}

/// [1 2 1]/4 along x or y; transparent outside.
Image smoothed(const Image& sharp, glm::ivec2 along) {
  Image soft = sharp;
  const auto value = [&](int x, int y, std::size_t c) {
    return x >= 0 && y >= 0 && x < sharp.w && y < sharp.h ? int{sharp.rgba[byteAt(sharp, x, y) + c]} : 0;
  };
  for (int y = 0; y < sharp.h; ++y)
    for (int x = 0; x < sharp.w; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        soft.rgba[byteAt(soft, x, y) + c] = static_cast<std::uint8_t>(
            (value(x - along.x, y - along.y, c) + 2 * value(x, y, c) + value(x + along.x, y + along.y, c) + 2) / 4);
  return soft;
}

/// What red-cyan glasses need: each colour mixed as that of both eyes.
void mixEyes(DisplayMode mode, Image& image) {
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    const double alpha = image.rgba[at + 3];
    if (alpha <= 0.0 || (image.rgba[at] == image.rgba[at + 1] && image.rgba[at] == image.rgba[at + 2])) continue;
    glm::dvec3 light;
    for (int c = 0; c < 3; ++c)
      light[c] = lightOfSrgb(std::min(1.0, image.rgba[at + static_cast<std::size_t>(c)] / alpha));
    light = anaglyph(mode, light, light);
    for (int c = 0; c < 3; ++c)
      image.rgba[at + static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(std::lround(alpha * srgbOfLight(light[c])));
  }
}

}  // namespace

std::vector<glm::ivec2> eyeAreas(const StereoLayout& layout) {
  const glm::ivec2 eye_px = eyeImageSize(layout.mode, layout.screen_px);
  switch (layout.mode) {
    case DisplayMode::side_by_side:
    case DisplayMode::side_by_side_full:
      return {{0, 0}, {eye_px.x, 0}};
    case DisplayMode::top_bottom:
    case DisplayMode::top_bottom_full:
      return {{0, 0}, {0, eye_px.y}};
    case DisplayMode::frame_packing:
      return {{0, 0}, {0, eye_px.y + packingGap_px(eye_px.y)}};
    default:
      return {{0, 0}};
  }
}

OverlayPatch patchOf(const OverlayPanel& panel, const StereoLayout& layout, const ScreenOrientation& orientation) {
  OverlayPatch patch;
  const glm::ivec2 eye_px = eyeImageSize(layout.mode, layout.screen_px);
  const glm::ivec2 by = glm::max(layout.screen_px / glm::max(eye_px, 1), 1);  // screen pixels for one of the eye's
  // The part on the screen; an odd last line of a halved screen belongs to no eye.
  const glm::ivec2 shown_px = eye_px * by;
  const PixelBox box = orientation.imageBox({panel.corner_px, {panel.image.w, panel.image.h}}, layout.screen_px);
  const glm::ivec2 low = glm::clamp(box.corner_px, glm::ivec2(0), shown_px);
  const glm::ivec2 high = glm::clamp(box.corner_px + box.size_px, glm::ivec2(0), shown_px);
  if (high.x <= low.x || high.y <= low.y) return patch;

  patch.image = averaged(cropped(turned(panel.image, orientation), {low - box.corner_px, high - low}), low, by);
  if (layout.mode == DisplayMode::row_interleaved) patch.image = smoothed(patch.image, {0, 1});
  if (layout.mode == DisplayMode::column_interleaved || layout.mode == DisplayMode::checkerboard)
    patch.image = smoothed(patch.image, {1, 0});
  if (isAnaglyph(layout.mode)) mixEyes(layout.mode, patch.image);
  for (const glm::ivec2& area : eyeAreas(layout)) patch.corners_px.push_back(area + low / by);
  return patch;
}

}  // namespace render
