#include "render/volume/legend_picture.h"

#include <algorithm>
#include <utility>

#include "render/volume/slice_text.h"

namespace render {

const glm::vec3 LegendPicture::kGround{18.0f, 20.0f, 22.0f};

LegendPicture::LegendPicture(const glm::ivec2& size_px, int line_px) : line_px_(line_px) {
  image_.w = size_px.x, image_.h = size_px.y;
  image_.rgba.assign(4 * static_cast<std::size_t>(size_px.x * size_px.y), 255);
  for (int y = 0; y < size_px.y; ++y)
    for (int x = 0; x < size_px.x; ++x) blend(x, y, kGround, 1.0f);
}

void LegendPicture::blend(int x, int y, const glm::vec3& colour, float share) {
  if (x < 0 || y < 0 || x >= image_.w || y >= image_.h) return;
  std::uint8_t* const to = &image_.rgba[4 * static_cast<std::size_t>(y * image_.w + x)];
  for (int c = 0; c < 3; ++c)
    to[c] = static_cast<std::uint8_t>(glm::mix(static_cast<float>(to[c]), std::clamp(colour[c], 0.0f, 255.0f), share) +
                                      0.5f);
}

void LegendPicture::write(const std::string& word, const glm::ivec2& corner_px) {
  const glm::vec3 letters(225.0f, 232.0f, 235.0f);
  forWordPixels(wordPixels(word, line_px_), corner_px, [&](int x, int y, bool is_rim, float share) {
    if (!is_rim) blend(x, y, letters, share);
  });
}

Image LegendPicture::done() { return std::move(image_); }

}  // namespace render
