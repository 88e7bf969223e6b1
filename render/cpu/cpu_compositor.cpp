#include "render/cpu/cpu_compositor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "render/display/anaglyph.h"

namespace render {
namespace {

// At a pixel of the eye's place, whose size is `place_px`.
glm::vec3 seen(const EyeImage& canvas, glm::ivec2 place_px, glm::ivec2 px) {
  if (canvas.px == place_px) {
    const std::size_t n = canvas.at(px.x, px.y);
    return {canvas.r[n], canvas.g[n], canvas.b[n]};
  }
  const glm::vec2 at = (glm::vec2(px) + 0.5f) * glm::vec2(canvas.px) / glm::vec2(place_px) - 0.5f;
  const glm::ivec2 low(glm::floor(at));
  const glm::vec2 part = at - glm::vec2(low);
  const auto corner = [&](int dx, int dy) {
    const glm::ivec2 c = glm::clamp(low + glm::ivec2(dx, dy), glm::ivec2(0), canvas.px - 1);
    const std::size_t n = canvas.at(c.x, c.y);
    return glm::vec3(canvas.r[n], canvas.g[n], canvas.b[n]);
  };
  return glm::mix(glm::mix(corner(0, 0), corner(1, 0), part.x), glm::mix(corner(0, 1), corner(1, 1), part.x), part.y);
}

// Bytes red first, whichever way the machine keeps its words.
void putRow(Image& image, int y, const std::uint32_t* rgba) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t bytes = 4 * static_cast<std::size_t>(image.w);
  std::memcpy(image.rgba.data() + static_cast<std::size_t>(y) * bytes, rgba, bytes);
}

}  // namespace

void compose(const StereoLayout& layout, const EyeImage& left, const EyeImage& right, const ShadeKernels& kernels,
             Image& output) {
  const glm::ivec2 size = outputSize(layout.mode, layout.screen_px);
  const glm::ivec2 place_px = eyeImageSize(layout.mode, layout.screen_px);
  output.w = size.x;
  output.h = size.y;
  output.rgba.resize(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  const auto width = static_cast<std::size_t>(size.x);
  const bool in_runs = layout.mode != DisplayMode::column_interleaved && layout.mode != DisplayMode::checkerboard &&
                       !isAnaglyph(layout.mode) && left.px == place_px && right.px == place_px;
  tbb::parallel_for(0, size.y, [&](int y) {
    thread_local std::vector<std::uint32_t> rgba;
    rgba.resize(width + kLanePadding);
    if (in_runs) {
      // A row shows one eye's row after the other: each is encoded where it lies.
      for (int x = 0; x < size.x; x += place_px.x) {
        const int run = std::min(place_px.x, size.x - x);
        const SourcePixel shown = sourcePixelAt(layout, {x, y});
        if (shown.eye == PixelSource::black) {
          std::fill_n(rgba.begin() + x, run, 0xff000000u);
          continue;
        }
        const EyeImage& canvas = shown.eye == PixelSource::right ? right : left;
        const std::size_t n = canvas.at(shown.px.x, shown.px.y);
        kernels.encode(&canvas.r[n], &canvas.g[n], &canvas.b[n], run, rgba.data() + x);
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
      switch (shown.eye) {
        case PixelSource::black:
          break;
        case PixelSource::left:
        case PixelSource::cyclopean:
          value = seen(left, place_px, shown.px);
          break;
        case PixelSource::right:
          value = seen(right, place_px, shown.px);
          break;
        case PixelSource::both: {
          const EyeImage &red = layout.swapped ? right : left, &cyan = layout.swapped ? left : right;
          value = glm::vec3(anaglyph(layout.mode, glm::dvec3(seen(red, place_px, shown.px)),
                                     glm::dvec3(seen(cyan, place_px, shown.px))));
          break;
        }
      }
      r[x] = value.r, g[x] = value.g, b[x] = value.b;
    }
    kernels.encode(r, g, b, size.x, rgba.data());
    putRow(output, y, rgba.data());
  });
}

}  // namespace render
