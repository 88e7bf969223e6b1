#include "render/volume/clearance_legend.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/shaders/light_constants.glsl"
#include "render/volume/slice_font.h"

namespace render {
namespace {

// In dots.
constexpr int kMargin = 3, kSwatchWidth = 11, kRowHeight = kLetterHeight + 3;
constexpr std::string_view kTitle = "TO CANAL";
constexpr std::array<std::string_view, 3> kBands{"<1 MM", "<2 MM", "<3 MM"};
constexpr int kLegendWidth = 2 * kMargin + static_cast<int>(kTitle.size()) * (kLetterWidth + 1);
constexpr int kLegendHeight = 2 * kMargin + 4 * kRowHeight - 3;

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

glm::ivec2 clearanceLegendSize(int dot_px) { return dot_px * glm::ivec2(kLegendWidth, kLegendHeight); }

Image clearanceLegend(int dot_px) {
  const glm::ivec2 size = clearanceLegendSize(dot_px);
  Image image;
  image.w = size.x, image.h = size.y;
  image.rgba.assign(4 * static_cast<std::size_t>(size.x * size.y), 255);
  const auto set = [&](int x, int y, const glm::vec3& colour) {
    if (x < 0 || y < 0 || x >= size.x || y >= size.y) return;
    std::uint8_t* const to = &image.rgba[4 * static_cast<std::size_t>(y * size.x + x)];
    for (int c = 0; c < 3; ++c) to[c] = static_cast<std::uint8_t>(std::clamp(colour[c], 0.0f, 255.0f) + 0.5f);
  };
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) set(x, y, kLegendGround);
  const auto write = [&](std::string_view word, int left, int top) {
    forWordPixels(word, dot_px * left, dot_px * top, dot_px, [&](int x, int y, bool is_rim) {
      if (!is_rim) set(x, y, kLegendText);
    });
  };
  write(kTitle, kMargin, kMargin);
  const std::array<glm::vec3, 3> colours{{{GUIDE_NEAR_COLOUR}, {GUIDE_MIDDLE_COLOUR}, {GUIDE_FAR_COLOUR}}};
  for (std::size_t band = 0; band < kBands.size(); ++band) {
    const int top = kMargin + (static_cast<int>(band) + 1) * kRowHeight;
    for (int y = 0; y < kLetterHeight * dot_px; ++y)
      for (int x = 0; x < kSwatchWidth * dot_px; ++x)
        set(dot_px * kMargin + x, dot_px * top + y,
            glm::mix(kLegendBone, shownColour(colours[band]), coverAt(band, x / dot_px, y / dot_px)));
    write(kBands[band], kMargin + kSwatchWidth + 4, top);
  }
  return image;
}

}  // namespace render
