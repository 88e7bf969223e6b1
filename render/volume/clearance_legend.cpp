#include "render/volume/clearance_legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "render/shaders/light_constants.glsl"
#include "render/volume/legend_picture.h"
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

const glm::vec3 kLegendBone{196.0f, 184.0f, 160.0f};

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
  LegendPicture picture(clearanceLegendSize(line_px), line_px);
  const int margin = marginOf(line_px), dot = dotOf(line_px);
  picture.write(kTitle, {margin, margin});
  const std::array<glm::vec3, 3> colours{{{GUIDE_NEAR_COLOUR}, {GUIDE_MIDDLE_COLOUR}, {GUIDE_FAR_COLOUR}}};
  for (std::size_t band = 0; band < kBands.size(); ++band) {
    const int top = margin + (static_cast<int>(band) + 1) * rowOf(line_px);
    for (int y = 0; y < line_px; ++y)
      for (int x = 0; x < swatchOf(line_px); ++x)
        picture.blend(margin + x, top + y,
                      glm::mix(kLegendBone, shownColour(colours[band]), coverAt(band, x / dot, y / dot)), 1.0f);
    picture.write(kBands[band], {2 * margin + swatchOf(line_px), top});
  }
  return picture.done();
}

}  // namespace render
