#include "render/volume/paint_legend.h"

#include <algorithm>
#include <cmath>

#include "render/volume/slice_text.h"

namespace render {
namespace {

const glm::vec3 kPaintLegendGround{18.0f, 20.0f, 22.0f}, kPaintLegendText{225.0f, 232.0f, 235.0f};

int paintMargin(int line_px) { return line_px / 2; }
int paintRow(int line_px) { return line_px + line_px / 4; }
int paintSwatch(int line_px) { return 3 * line_px / 2; }

glm::vec3 srgbFromLinear(const glm::vec3& linear) {
  const glm::vec3 power = 1.055f * glm::pow(glm::max(linear, 0.0f), glm::vec3(1.0f / 2.4f)) - 0.055f;
  return glm::mix(12.92f * linear, power, glm::vec3(glm::greaterThan(linear, glm::vec3(0.0031308f))));
}

}  // namespace

glm::ivec2 paintLegendSize(const SurfacePaint& paint, int line_px) {
  int wide = wordPixels(paint.title, line_px).size_px.x;
  for (const SurfacePaint::Row& row : paint.rows)
    wide = std::max(wide, paintSwatch(line_px) + paintMargin(line_px) + wordPixels(row.means, line_px).size_px.x);
  return {2 * paintMargin(line_px) + wide,
          2 * paintMargin(line_px) + static_cast<int>(paint.rows.size() + 1) * paintRow(line_px)};
}

Image paintLegend(const SurfacePaint& paint, int line_px) {
  const glm::ivec2 size = paintLegendSize(paint, line_px);
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
    for (int x = 0; x < size.x; ++x) blend(x, y, kPaintLegendGround, 1.0f);
  const auto write = [&](const std::string& word, int left, int top) {
    forWordPixels(wordPixels(word, line_px), {left, top}, [&](int x, int y, bool is_rim, float share) {
      if (!is_rim) blend(x, y, kPaintLegendText, share);
    });
  };
  const int margin = paintMargin(line_px);
  write(paint.title, margin, margin);
  for (std::size_t n = 0; n < paint.rows.size(); ++n) {
    const int top = margin + (static_cast<int>(n) + 1) * paintRow(line_px);
    const auto& linear = paint.rows[n].linear;
    const glm::vec3 colour = linear ? 255.0f * srgbFromLinear(*linear) : kPaintLegendGround;
    for (int y = 0; y < paintRow(line_px); ++y)
      for (int x = 0; x < paintSwatch(line_px); ++x) blend(margin + x, top + y, colour, 1.0f);
    write(paint.rows[n].means, 2 * margin + paintSwatch(line_px), top + (paintRow(line_px) - line_px) / 2);
  }
  return image;
}

}  // namespace render
