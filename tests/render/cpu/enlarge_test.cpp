#include "render/cpu/enlarge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace render {
namespace {

using LightAt = std::function<glm::vec3(glm::vec2)>;  // of a point, both coordinates 0..1

EyeImage sampled(glm::ivec2 px, const LightAt& light, int samples = 1) {
  EyeImage image;
  image.resize(px);
  for (int y = 0; y < px.y; ++y)
    for (int x = 0; x < px.x; ++x) {
      glm::vec3 sum(0.0f);
      for (int s = 0; s < samples * samples; ++s) {
        const glm::vec2 part = (glm::vec2(s % samples, s / samples) + 0.5f) / static_cast<float>(samples);
        sum += light((glm::vec2(x, y) + part) / glm::vec2(px));
      }
      sum /= static_cast<float>(samples * samples);
      const std::size_t n = image.at(x, y);
      image.r[n] = sum.r, image.g[n] = sum.g, image.b[n] = sum.b;
    }
  return image;
}

glm::vec3 at(const EyeImage& image, int x, int y) {
  const std::size_t n = image.at(x, y);
  return {image.r[n], image.g[n], image.b[n]};
}

/// What the OpenGL back-end does.
glm::vec3 bilinear(const EyeImage& from, glm::ivec2 px, int x, int y) {
  const glm::vec2 place = (glm::vec2(x, y) + 0.5f) * glm::vec2(from.px) / glm::vec2(px) - 0.5f;
  const glm::ivec2 low(glm::floor(place));
  const glm::vec2 part = place - glm::vec2(low);
  const auto corner = [&](int dx, int dy) {
    const glm::ivec2 c = glm::clamp(low + glm::ivec2(dx, dy), glm::ivec2(0), from.px - 1);
    return at(from, c.x, c.y);
  };
  return glm::mix(glm::mix(corner(0, 0), corner(1, 0), part.x), glm::mix(corner(0, 1), corner(1, 1), part.x), part.y);
}

EyeImage enlarged(const EyeImage& from, glm::ivec2 px) {
  Enlarger enlarger;
  EyeImage to;
  enlarger.enlarge(from, px, to);
  return to;
}

constexpr glm::ivec2 kSmall{48, 32};

TEST(Enlarge, IsBilinearWhereThereIsNoEdge) {
  const EyeImage shade =
      sampled(kSmall, [](glm::vec2 p) { return glm::vec3(0.3f + 0.2f * p.x, 0.5f - 0.1f * p.y, 0.2f); });
  const glm::ivec2 px = 3 * kSmall;
  const EyeImage large = enlarged(shade, px);
  for (int y = 0; y < px.y; ++y)
    for (int x = 0; x < px.x; ++x) EXPECT_LT(glm::distance(at(large, x, y), bilinear(shade, px, x, y)), 1e-6f);
}

TEST(Enlarge, EvenlyIsBilinearAcrossEdgesToo) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> light(0.0f, 1.0f);
  const EyeImage small = sampled(kSmall, [&](glm::vec2) { return glm::vec3(light(random), light(random), 0.5f); });
  const glm::ivec2 px = 4 * kSmall;
  Enlarger enlarger;
  EyeImage large;
  enlarger.enlarge(small, px, large, Enlarger::Edges::even);
  for (int y = 0; y < px.y; ++y)
    for (int x = 0; x < px.x; ++x) EXPECT_LT(glm::distance(at(large, x, y), bilinear(small, px, x, y)), 1e-6f);
}

/// Against the same edge drawn at full size with smooth edges: nearer than bilinear, for edges of any direction.
TEST(Enlarge, AnEdgeOfAnyDirectionIsNearerToTheTruthThanBilinear) {
  for (const int factor : {2, 3}) {
    const glm::ivec2 px = factor * kSmall;
    double all = 0.0, all_bilinear = 0.0;
    for (int degrees = 1; degrees < 180; degrees += 7) {
      const float angle = static_cast<float>(degrees) * 0.0174533f;
      const LightAt edge = [&](glm::vec2 p) {
        const glm::vec2 from_middle = (p - 0.5f) * glm::vec2(kSmall);
        const bool inside = from_middle.x * std::cos(angle) + from_middle.y * std::sin(angle) > 0.3f;
        return inside ? glm::vec3(0.75f, 0.7f, 0.6f) : glm::vec3(0.35f, 0.1f, 0.1f);
      };
      const EyeImage small = sampled(kSmall, edge), truth = sampled(px, edge, 4), large = enlarged(small, px);
      double error = 0.0, error_bilinear = 0.0;
      for (int y = 8; y < px.y - 8; ++y)
        for (int x = 8; x < px.x - 8; ++x) {
          error += glm::distance(at(large, x, y), at(truth, x, y));
          error_bilinear += glm::distance(bilinear(small, px, x, y), at(truth, x, y));
        }
      EXPECT_LT(error, 1.02 * error_bilinear) << degrees << " degrees, times " << factor;
      all += error, all_bilinear += error_bilinear;
    }
    EXPECT_LT(all, (factor == 2 ? 0.75 : 0.83) * all_bilinear) << "times " << factor;
  }
}

TEST(Enlarge, AddsNoColourBeyondTheNeighbours) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> light(0.0f, 1.0f);
  for (const glm::ivec2 px : {glm::ivec2(96, 64), glm::ivec2(144, 96), glm::ivec2(50, 33), glm::ivec2(48, 64)}) {
    const EyeImage small = sampled(kSmall, [&](glm::vec2) { return glm::vec3(light(random), light(random), 0.5f); });
    const EyeImage large = enlarged(small, px);
    for (int y = 0; y < px.y; ++y)
      for (int x = 0; x < px.x; ++x) {
        glm::vec3 low(1.0f), high(0.0f);
        const glm::vec2 place = (glm::vec2(x, y) + 0.5f) * glm::vec2(kSmall) / glm::vec2(px) - 0.5f;
        for (int j = -3; j <= 3; ++j)
          for (int i = -3; i <= 3; ++i) {
            const glm::ivec2 c =
                glm::clamp(glm::ivec2(glm::floor(place)) + glm::ivec2(i, j), glm::ivec2(0), kSmall - 1);
            low = glm::min(low, at(small, c.x, c.y)), high = glm::max(high, at(small, c.x, c.y));
          }
        const glm::vec3 is = at(large, x, y);
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(is, low - 1e-6f)) && glm::all(glm::lessThanEqual(is, high + 1e-6f)));
      }
  }
}

TEST(Enlarge, TheSmallestImagesAreEnlargedToo) {
  for (const glm::ivec2 small : {glm::ivec2(1, 1), glm::ivec2(1, 5), glm::ivec2(2, 1)}) {
    const EyeImage image = sampled(small, [](glm::vec2 p) { return glm::vec3(p.x > 0.5f ? 1.0f : 0.0f); });
    const EyeImage large = enlarged(image, 3 * small);
    EXPECT_EQ(large.px, 3 * small);
    for (const float value : large.r) EXPECT_TRUE(value >= 0.0f && value <= 1.0f);
  }
}

}  // namespace
}  // namespace render
