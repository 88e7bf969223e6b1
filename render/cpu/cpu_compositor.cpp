#include "render/cpu/cpu_compositor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "render/display/anaglyph.h"

namespace render {
namespace {

// The eye at a pixel of its area in the output, `full_px` large.
glm::vec3 seen(const EyeImage& image, glm::ivec2 full_px, glm::ivec2 px) {
  if (image.px == full_px) {
    const std::size_t n = image.at(px.x, px.y);
    return {image.r[n], image.g[n], image.b[n]};
  }
  const glm::vec2 at = (glm::vec2(px) + 0.5f) * glm::vec2(image.px) / glm::vec2(full_px) - 0.5f;
  const glm::ivec2 low(glm::floor(at));
  const glm::vec2 part = at - glm::vec2(low);
  const auto corner = [&](int dx, int dy) {
    const glm::ivec2 c = glm::clamp(low + glm::ivec2(dx, dy), glm::ivec2(0), image.px - 1);
    const std::size_t n = image.at(c.x, c.y);
    return glm::vec3(image.r[n], image.g[n], image.b[n]);
  };
  return glm::mix(glm::mix(corner(0, 0), corner(1, 0), part.x), glm::mix(corner(0, 1), corner(1, 1), part.x), part.y);
}

// Bytes red first.
void putRow(Image& image, int y, const std::uint32_t* rgba) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t bytes = 4 * static_cast<std::size_t>(image.w);
  std::memcpy(image.rgba.data() + static_cast<std::size_t>(y) * bytes, rgba, bytes);
}

}  // namespace

void compose(const StereoLayout& layout, const EyeImage& left, const EyeImage& right, const ShadeKernels& kernels,
             Image& output) {
  const glm::ivec2 size = outputSize(layout.mode, layout.screen_px);
  const glm::ivec2 full_px = eyeImageSize(layout.mode, layout.screen_px);
  output.w = size.x;
  output.h = size.y;
  output.rgba.resize(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  const auto width = static_cast<std::size_t>(size.x);
  const bool in_runs = layout.mode != DisplayMode::column_interleaved && layout.mode != DisplayMode::checkerboard &&
                       !isAnaglyph(layout.mode) && left.px == full_px && right.px == full_px;
  tbb::parallel_for(0, size.y, [&](int y) {
    thread_local std::vector<std::uint32_t> rgba;
    rgba.resize(width + kLanePadding);
    if (in_runs) {
      // A row consists of whole eye rows: each is encoded directly.
      for (int x = 0; x < size.x; x += full_px.x) {
        const int run = std::min(full_px.x, size.x - x);
        const SourcePixel shown = sourcePixelAt(layout, {x, y});
        if (shown.eye == PixelSource::black) {
          std::fill_n(rgba.begin() + x, run, 0xff000000u);
          continue;
        }
        const EyeImage& image = shown.eye == PixelSource::right ? right : left;
        const std::size_t n = image.at(shown.px.x, shown.px.y);
        kernels.encode(&image.r[n], &image.g[n], &image.b[n], run, rgba.data() + x);
      }
      putRow(output, y, rgba.data());
      return;
    }
    thread_local std::vector<float> light;
    light.resize(3 * (width + kLanePadding));
    float *const r = light.data(), *const g = r + width + kLanePadding, *const b = g + width + kLanePadding;
    for (int x = 0; x < size.x; ++x) {
      const SourcePixel shown = sourcePixelAt(layout, {x, y});
      glm::vec3 value(0.0f);
      if (shown.eye == PixelSource::both) {
        const EyeImage &red = layout.swapped ? right : left, &cyan = layout.swapped ? left : right;
        value = glm::vec3(
            anaglyph(layout.mode, glm::dvec3(seen(red, full_px, shown.px)), glm::dvec3(seen(cyan, full_px, shown.px))));
      } else if (shown.eye != PixelSource::black) {
        value = seen(shown.eye == PixelSource::right ? right : left, full_px, shown.px);
      }
      r[x] = value.r, g[x] = value.g, b[x] = value.b;
    }
    kernels.encode(r, g, b, size.x, rgba.data());
    putRow(output, y, rgba.data());
  });
}

void blendOver(const OverlayPatch& patch, Image& output) {
  for (const glm::ivec2& corner : patch.corners_px)
    for (int y = 0; y < patch.image.h; ++y) {
      const std::uint8_t* from = &patch.image.rgba[4 * static_cast<std::size_t>(y * patch.image.w)];
      std::uint8_t* to = &output.rgba[4 * static_cast<std::size_t>((corner.y + y) * output.w + corner.x)];
      for (int x = 0; x < patch.image.w; ++x, from += 4, to += 4)
        for (int c = 0; c < 3; ++c)
          to[c] = static_cast<std::uint8_t>(std::min(255, from[c] + (to[c] * (255 - from[3]) + 127) / 255));
    }
}

}  // namespace render
