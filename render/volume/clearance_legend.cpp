#include "render/volume/clearance_legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "render/shaders/light_constants.glsl"
#include "render/volume/slice_text.h"

namespace render {
namespace {

const std::string kTitle = "to the canal";
const std::array<std::string, 3> kBands{"< 1 mm", "< 2 mm", "< 3 mm"};

int marginOf(int line_px) { return line_px / 2; }
int rowOf(int line_px) { return line_px + line_px / 3; }
/// A swatch's width; its patterns are drawn in dots.
int swatchOf(int line_px) { return 3 * line_px / 2; }
int dotOf(int line_px) { return std::max(1, line_px / 9); }

const glm::vec3 kLegendGround{18.0f, 20.0f, 22.0f}, kLegendBone{196.0f, 184.0f, 160.0f},
    kLegendText{225.0f, 232.0f, 235.0f};

/// sRGB 0..255 of a guide's linear colour.
glm::vec3 shownColour(const glm::vec3& linear) { return 255.0f * glm::pow(linear, glm::vec3(1.0f / 2.2f)); }

/// Share of the band's colour at a dot of its swatch: full, striped, dotted, as the shader has it.
float coverAt(std::size_t band, int x, int y) {
  if (band == 0) return GUIDE_FULL_COVER;
  if (band == 1) return (x + y) % 4 < 2 ? GUIDE_FULL_COVER : GUIDE_STRIPE_GAP_COVER;
  return x % 3 == 1 && y % 3 == 1 ? GUIDE_DOT_COVER : GUIDE_DOT_GAP_COVER;
}

}  // namespace

glm::ivec2 clearanceLegendSize(int line_px) {
  int wide = wordPixels(kTitle, line_px).size_px.x;
  for (const std::string& band : kBands)
    wide = std::max(wide, swatchOf(line_px) + marginOf(line_px) + wordPixels(band, line_px).size_px.x);
  return {2 * marginOf(line_px) + wide, 2 * marginOf(line_px) + 3 * rowOf(line_px) + line_px};
}

Image clearanceLegend(int line_px) {
  const glm::ivec2 size = clearanceLegendSize(line_px);
  Image image;
  image.w = size.x, image.h = size.y;
  image.rgba.assign(4 * static_cast<std::size_t>(size.x * size.y), 255);
  const auto blend = [&](int x, int y, const glm::vec3& colour, float share) {
    if (x < 0 || y < 0 || x >= size.x || y >= size.y) return;
    std::uint8_t* const to = &image.rgba[4 * static_cast<std::size_t>(y * size.x + x)];
    for (int c = 0; c < 3; ++c)
      to[c] = static_cast<std::uint8_t>(
          glm::mix(static_cast<float>(to[c]), std::clamp(colour[c], 0.0f, 255.0f), share) + 0.5f);
  };
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) blend(x, y, kLegendGround, 1.0f);
  const auto write = [&](const std::string& word, int left, int top) {
    forWordPixels(wordPixels(word, line_px), {left, top}, [&](int x, int y, bool is_rim, float share) {
      if (!is_rim) blend(x, y, kLegendText, share);
    });
  };
  const int margin = marginOf(line_px), dot = dotOf(line_px);
  write(kTitle, margin, margin);
  const std::array<glm::vec3, 3> colours{{{GUIDE_NEAR_COLOUR}, {GUIDE_MIDDLE_COLOUR}, {GUIDE_FAR_COLOUR}}};
  for (std::size_t band = 0; band < kBands.size(); ++band) {
    const int top = margin + (static_cast<int>(band) + 1) * rowOf(line_px);
    for (int y = 0; y < line_px; ++y)
      for (int x = 0; x < swatchOf(line_px); ++x)
        blend(margin + x, top + y, glm::mix(kLegendBone, shownColour(colours[band]), coverAt(band, x / dot, y / dot)),
              1.0f);
    write(kBands[band], 2 * margin + swatchOf(line_px), top);
  }
  return image;
}

}  // namespace render
