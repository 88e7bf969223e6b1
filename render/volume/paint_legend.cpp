#include "render/volume/paint_legend.h"

#include <algorithm>
#include <cmath>

#include "render/volume/legend_picture.h"
#include "render/volume/slice_text.h"

namespace render {
namespace {

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
  LegendPicture picture(paintLegendSize(paint, line_px), line_px);
  const int margin = paintMargin(line_px);
  picture.write(paint.title, {margin, margin});
  for (std::size_t n = 0; n < paint.rows.size(); ++n) {
    const int top = margin + (static_cast<int>(n) + 1) * paintRow(line_px);
    const auto& linear = paint.rows[n].linear;
    const glm::vec3 colour = linear ? 255.0f * srgbFromLinear(*linear) : LegendPicture::kGround;
    for (int y = 0; y < paintRow(line_px); ++y)
      for (int x = 0; x < paintSwatch(line_px); ++x) picture.blend(margin + x, top + y, colour, 1.0f);
    picture.write(paint.rows[n].means, {2 * margin + paintSwatch(line_px), top + (paintRow(line_px) - line_px) / 2});
  }
  return picture.done();
}

}  // namespace render
