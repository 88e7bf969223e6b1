#include "calibration/webcam/tip_spot.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "calibration/calibration_error.h"
#include "tests/calibration/webcam/seen_screen.h"

namespace calibration {
namespace {

constexpr glm::ivec2 kSize{640, 360};

/// A disc with a soft edge, its light added to an image.
void light(GreyImage& image, const glm::dvec2& at, double radius_px, double height, double soft_px = 0.7,
           double smear_px = 0.0) {
  for (int y = 0; y < image.size_px.y; ++y)
    for (int x = 0; x < image.size_px.x; ++x) {
      const double across = std::max(0.0, std::abs(x - at.x) - smear_px);
      const double inside = radius_px - std::hypot(across, y - at.y);
      const double share = 0.5 * (1.0 + std::erf(inside / (1.414 * soft_px)));
      std::uint8_t& grey = image.grey[static_cast<std::size_t>(y * image.size_px.x + x)];
      grey = static_cast<std::uint8_t>(std::clamp(std::lround(grey + height * share), 0L, 255L));
    }
}

/// A bench with some pattern on it.
GreyImage bench() {
  GreyImage image{kSize, {}};
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      image.grey.push_back(static_cast<std::uint8_t>(40 + 15 * ((x / 37 + y / 29) % 2) + x / 40));
  return image;
}

struct Taken {
  GreyImage before, with;
};
Taken taken(const GreyImage& before, const GreyImage& with, unsigned seed, double noise = 2.0) {
  return {noisy(before, noise, seed), noisy(with, noise, seed + 1000)};
}

TEST(TipSpot, FindsTheCentreToAFifthOfAPixel) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> across(20.0, 620.0), down(20.0, 340.0), radius(2.0, 5.0);
  for (unsigned i = 0; i < 12; ++i) {
    const glm::dvec2 at(across(rng), down(rng));
    GreyImage with = bench();
    light(with, at, radius(rng), i % 3 == 0 ? 250.0 : 120.0);
    const Taken images = taken(bench(), with, i);
    const TipSpot spot = findTipSpot(images.before, images.with);
    ASSERT_FALSE(spot.trouble) << spot.line;
    EXPECT_LT(glm::distance(spot.centre_px, at), 0.2) << i;
  }
}

TEST(TipSpot, IsFoundWhileLightDriftsAndAShadowMoves) {
  const glm::dvec2 at(402.3, 171.8);
  GreyImage with = bench();
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      int change = 12 + x / 60;                                   // cloud
      if (x > 80 && x < 260 && y > 200) change -= 35;             // a hand's shadow appeared
      if (x > 300 && x < 385 && y > 60 && y < 330) change += 25;  // another disappeared
      std::uint8_t& grey = with.grey[static_cast<std::size_t>(y * kSize.x + x)];
      grey = static_cast<std::uint8_t>(std::clamp(grey + change, 0, 255));
    }
  light(with, at, 3.0, 130.0);
  const Taken images = taken(bench(), with, 3);
  const TipSpot spot = findTipSpot(images.before, images.with);
  ASSERT_FALSE(spot.trouble) << spot.line;
  EXPECT_LT(glm::distance(spot.centre_px, at), 0.25);
}

TEST(TipSpot, RefusesAnImageWithoutTip) {
  const Taken images = taken(bench(), bench(), 1, 4.0);
  EXPECT_EQ(findTipSpot(images.before, images.with).trouble, SpotTrouble::nothing);
  EXPECT_EQ(findTipSpot(bench(), bench()).trouble, SpotTrouble::nothing);
  GreyImage dead_pixel = bench();
  dead_pixel.grey[100 * 640 + 300] = 255;
  EXPECT_EQ(findTipSpot(bench(), dead_pixel).trouble, SpotTrouble::nothing);
}

TEST(TipSpot, RefusesTwoOfThem) {
  GreyImage with = bench();
  light(with, {200, 100}, 3.0, 140.0);
  light(with, {420, 250}, 3.0, 100.0);
  const Taken images = taken(bench(), with, 2);
  EXPECT_EQ(findTipSpot(images.before, images.with).trouble, SpotTrouble::several);
}

TEST(TipSpot, AcceptsAFaintReflection) {
  GreyImage with = bench();
  light(with, {200, 100}, 3.0, 180.0);
  light(with, {204, 122}, 3.0, 30.0);
  const Taken images = taken(bench(), with, 2);
  const TipSpot spot = findTipSpot(images.before, images.with);
  ASSERT_FALSE(spot.trouble) << spot.line;
  EXPECT_LT(glm::distance(spot.centre_px, glm::dvec2(200, 100)), 0.2);
}

TEST(TipSpot, RefusesAGlare) {
  for (const double radius : {14.0, 40.0, 120.0}) {
    GreyImage with = bench();
    light(with, {300, 180}, radius, 300.0);
    const Taken images = taken(bench(), with, 4);
    EXPECT_EQ(findTipSpot(images.before, images.with).trouble, SpotTrouble::too_large) << radius;
  }
}

TEST(TipSpot, RefusesOneAtTheEdge) {
  for (const glm::dvec2& at : {glm::dvec2(1, 100), glm::dvec2(638, 30), glm::dvec2(300, 2), glm::dvec2(300, 359)}) {
    GreyImage with = bench();
    light(with, at, 3.5, 150.0);
    const Taken images = taken(bench(), with, 6);
    EXPECT_EQ(findTipSpot(images.before, images.with).trouble, SpotTrouble::at_the_edge) << at.x << ' ' << at.y;
  }
}

TEST(TipSpot, RefusesOneThatMovedOrIsOutOfFocus) {
  GreyImage moved = bench(), soft = bench();
  light(moved, {300, 180}, 3.0, 150.0, 0.7, 6.0);
  light(soft, {300, 180}, 2.0, 320.0, 5.0);
  EXPECT_EQ(findTipSpot(noisy(bench(), 2.0, 1), noisy(moved, 2.0, 2)).trouble, SpotTrouble::blurred);
  EXPECT_EQ(findTipSpot(noisy(bench(), 2.0, 1), noisy(soft, 2.0, 2)).trouble, SpotTrouble::blurred);
}

TEST(TipSpot, RequiresTwoImagesOfOneSize) {
  EXPECT_THROW(findTipSpot(bench(), {{320, 180}, std::vector<std::uint8_t>(320 * 180)}), CalibrationError);
  EXPECT_THROW(findTipSpot({}, {}), CalibrationError);
}

}  // namespace
}  // namespace calibration
