#include "app/report/stereo_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "app/report/screen_page.h"
#include "render/display/anaglyph.h"

namespace app {
namespace {

using render::Image;
using render::PixelSource;

const std::uint8_t* pixelOf(const Image& picture, glm::ivec2 px) {
  return picture.rgba.data() +
         4 * (static_cast<std::size_t>(px.y) * static_cast<std::size_t>(picture.w) + static_cast<std::size_t>(px.x));
}

std::array<double, 256> linearOfBytes() {
  std::array<double, 256> light{};
  for (std::size_t byte = 0; byte < light.size(); ++byte) {
    const double s = static_cast<double>(byte) / 255.0;
    light[byte] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  return light;
}

/// Mixes two colours and caches the last result, as pages are mostly of one colour.
class Mixer {
 public:
  Mixer(render::DisplayMode mode, bool swapped) : mode_(mode), swapped_(swapped), light_(linearOfBytes()) {}

  void mix(const std::uint8_t* left, const std::uint8_t* right, std::uint8_t* to) {
    if (!has_last_ || std::memcmp(left, last_left_, 4) != 0 || std::memcmp(right, last_right_, 4) != 0) {
      std::memcpy(last_left_, left, 4);
      std::memcpy(last_right_, right, 4);
      has_last_ = true;
      const glm::dvec3 first = lightOf(swapped_ ? right : left), second = lightOf(swapped_ ? left : right);
      const glm::dvec3 mixed = render::anaglyph(mode_, first, second);
      for (int c = 0; c < 3; ++c) mixed_[c] = encoded(mixed[c]);
    }
    std::memcpy(to, mixed_, 4);
  }

 private:
  glm::dvec3 lightOf(const std::uint8_t* c) const { return {light_[c[0]], light_[c[1]], light_[c[2]]}; }

  render::DisplayMode mode_;
  bool swapped_;
  std::array<double, 256> light_;
  bool has_last_ = false;
  std::uint8_t last_left_[4]{}, last_right_[4]{}, mixed_[4]{0, 0, 0, 255};
};

/// Whether consecutive pixels of a row come from one eye alone.
bool runsAlongRows(render::DisplayMode mode) {
  return mode != render::DisplayMode::column_interleaved && mode != render::DisplayMode::checkerboard &&
         !render::isAnaglyph(mode);
}

}  // namespace

Image stereoPicture(const Image& left, const Image& right, const render::StereoLayout& layout) {
  const glm::ivec2 size = render::outputSize(layout.mode, layout.screen_px);
  const int eye_w = render::eyeImageSize(layout.mode, layout.screen_px).x;
  Image all{size.x, size.y, {}};
  all.rgba.resize(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  Mixer mixer(layout.mode, layout.swapped);
  const int most = runsAlongRows(layout.mode) ? eye_w : 1;
  for (int y = 0; y < size.y; ++y) {
    std::uint8_t* to = all.rgba.data() + 4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x);
    for (int x = 0; x < size.x;) {
      const render::SourcePixel shown = render::sourcePixelAt(layout, {x, y});
      const int count = std::min(most, size.x - x);
      if (shown.eye == PixelSource::both) {
        mixer.mix(pixelOf(left, shown.px), pixelOf(right, shown.px), to);
      } else if (shown.eye == PixelSource::black) {
        for (int n = 0; n < count; ++n) to[4 * n + 3] = 255;
      } else {
        std::memcpy(to, pixelOf(shown.eye == PixelSource::right ? right : left, shown.px),
                    4 * static_cast<std::size_t>(count));
      }
      x += count;
      to += 4 * count;
    }
  }
  return all;
}

}  // namespace app
