#include "render/display/stereo_compositor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "render/display/anaglyph.h"
#include "render/gpu/offscreen_context.h"

namespace render {
namespace {

// An eye's image of random light, top row first, and its texture.
struct RandomEye {
  RandomEye(glm::ivec2 size, unsigned seed) : px(size), texture(Texture::image(size, TexelFormat::rgba8)) {
    std::mt19937 random(seed);
    for (int i = 0; i < 4 * px.x * px.y; ++i) bytes.push_back(static_cast<std::uint8_t>(random() & 255u));
    // OpenGL's bottom row is first.
    std::vector<std::uint8_t> from_below;
    for (int y = px.y - 1; y >= 0; --y)
      from_below.insert(from_below.end(), bytes.begin() + 4 * y * px.x, bytes.begin() + 4 * (y + 1) * px.x);
    texture.uploadImage(std::as_bytes(std::span(from_below)));
  }

  glm::dvec3 at(glm::ivec2 p) const {
    p = glm::clamp(p, glm::ivec2(0), px - 1);
    const std::uint8_t* c = bytes.data() + 4 * (p.y * px.x + p.x);
    return glm::dvec3(c[0], c[1], c[2]) / 255.0;
  }

  glm::ivec2 px;
  std::vector<std::uint8_t> bytes;
  Texture texture;
};

// The output pass for one value, in double.
glm::dvec3 shouldered(const glm::dvec3& x) {
  const glm::dvec3 over = glm::max(x - 0.7, 0.0) / 0.3;
  return glm::min(x, 0.7) + 0.3 * (over / (1.0 + over));
}

double encoded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

// Light at a pixel of the eye's area, bilinear if the image is smaller.
glm::dvec3 seen(const RandomEye& eye, glm::ivec2 place_px, glm::ivec2 px) {
  if (eye.px == place_px) return shouldered(eye.at(px));
  const glm::dvec2 at = (glm::dvec2(px) + 0.5) * glm::dvec2(eye.px) / glm::dvec2(place_px) - 0.5;
  const glm::dvec2 low = glm::floor(at), part = at - low;
  const auto tap = [&](int i, int j) { return shouldered(eye.at(glm::ivec2(low) + glm::ivec2(i, j))); };
  return glm::mix(glm::mix(tap(0, 0), tap(1, 0), part.x), glm::mix(tap(0, 1), tap(1, 1), part.x), part.y);
}

// Largest channel difference, of 255, between the shader and the layout in C++.
int worstDifference(StereoCompositor& compositor, StereoLayout layout, const RandomEye& left, const RandomEye& right) {
  const glm::ivec2 size = outputSize(layout.mode, layout.screen_px),
                   place = eyeImageSize(layout.mode, layout.screen_px);
  const Framebuffer output(size, std::array{TexelFormat::rgba8}, false);
  int worst = 0;
  for (layout.output = 0; layout.output < outputCount(layout.mode); ++layout.output) {
    compositor.compose(layout, left.texture, right.texture, 1, output);
    const std::vector<std::uint8_t> rows = output.readRgba8(0);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const SourcePixel shown = sourcePixelAt(layout, {x, y});
        glm::dvec3 light(0.0);
        if (shown.eye == PixelSource::left || shown.eye == PixelSource::cyclopean) light = seen(left, place, shown.px);
        if (shown.eye == PixelSource::right) light = seen(right, place, shown.px);
        if (shown.eye == PixelSource::both)
          light = layout.swapped ? anaglyph(layout.mode, seen(right, place, shown.px), seen(left, place, shown.px))
                                 : anaglyph(layout.mode, seen(left, place, shown.px), seen(right, place, shown.px));
        const std::uint8_t* got = rows.data() + 4 * ((size.y - 1 - y) * size.x + x);
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(got[c] - static_cast<int>(std::lround(255.0 * encoded(light[c])))));
      }
  }
  return worst;
}

TEST(StereoCompositor, EveryPixelOfEveryModeShowsWhatTheLayoutSays) {
  const OffscreenContext context;
  StereoCompositor compositor;
  for (const DisplayModeName& one : kDisplayModes)
    for (const bool swapped : {false, true})
      for (const glm::ivec2 at : {glm::ivec2(0, 0), glm::ivec2(3, 0), glm::ivec2(0, 5), glm::ivec2(-1, 1)}) {
        const StereoLayout layout{.mode = one.mode, .screen_px = {50, 48}, .at_px = at, .swapped = swapped};
        const glm::ivec2 eye_px = eyeImageSize(one.mode, layout.screen_px);
        // One step for rounding in float.
        EXPECT_LE(worstDifference(compositor, layout, RandomEye(eye_px, 1), RandomEye(eye_px, 2)), 1) << one.name;
      }
}

TEST(StereoCompositor, SmallerImagesAreScaledBilinearly) {
  const OffscreenContext context;
  StereoCompositor compositor;
  for (const DisplayModeName& one : kDisplayModes) {
    const StereoLayout layout{.mode = one.mode, .screen_px = {50, 47}};
    const glm::ivec2 eye_px = (eyeImageSize(one.mode, layout.screen_px) + 1) / 2;
    EXPECT_LE(worstDifference(compositor, layout, RandomEye(eye_px, 3), RandomEye(eye_px, 4)), 1) << one.name;
  }
}

TEST(StereoCompositor, AnotherLayoutGivesAnotherImage) {
  const OffscreenContext context;
  const RandomEye left({50, 48}, 1), right({50, 48}, 2);
  StereoCompositor compositor;
  const auto pictureOf = [&](const StereoLayout& layout) {
    const Framebuffer output({50, 48}, std::array{TexelFormat::rgba8}, false);
    compositor.compose(layout, left.texture, right.texture, 1, output);
    return output.readRgba8(0);
  };
  StereoLayout layout{.mode = DisplayMode::checkerboard, .screen_px = {50, 48}};
  const auto as_is = pictureOf(layout);
  layout.at_px = {1, 0};
  const auto moved = pictureOf(layout);
  EXPECT_NE(as_is, moved);
  layout.swapped = true;
  EXPECT_EQ(as_is, pictureOf(layout)) << "moved by one and swapped is as it was";
}

}  // namespace
}  // namespace render
