#include "app/pattern/test_pattern.h"

#include <gtest/gtest.h>

#include "app/report/screen_page.h"

namespace app {
namespace {

using render::DisplayMode;
using render::Eye;
using render::Image;

glm::ivec3 pixelAt(const Image& picture, int x, int y) {
  const std::uint8_t* c = picture.rgba.data() + 4 * (y * picture.w + x);
  return {c[0], c[1], c[2]};
}

calibration::Rig desk() { return calibration::desktopRig({320, 200}, 320.0); }

/// The same virtual screen by a panel behind a mirror.
calibration::Rig throughMirror() {
  calibration::Rig rig = desk();
  const calibration::ScreenCorners seen = rig.screen;
  rig.mirror = calibration::Plane<calibration::World>{glm::normalize(glm::dvec3(0.0, 0.7, 0.7)), 40.0};
  rig.screen.lower_left = rig.mirror->reflect(seen.lower_right);
  rig.screen.lower_right = rig.mirror->reflect(seen.lower_left);
  rig.screen.upper_left = rig.mirror->reflect({seen.lower_right.mm + seen.upper_left.mm - seen.lower_left.mm});
  return rig;
}

TEST(TestPattern, EveryNameIsFoundAndEveryPatternDrawsInEveryMode) {
  EXPECT_FALSE(testPatternNamed("snow"));
  for (const TestPatternName& one : kTestPatterns) {
    EXPECT_EQ(testPatternNamed(one.name), one.pattern);
    for (const render::DisplayModeName& mode : render::kDisplayModes) {
      const render::StereoLayout layout{.mode = mode.mode, .screen_px = {96, 72}};
      const Image all = patternOutput(one.pattern, desk(), layout);
      EXPECT_EQ(glm::ivec2(all.w, all.h), render::outputSize(mode.mode, {96, 72}));
      EXPECT_EQ(all.rgba.size(), 4u * static_cast<std::size_t>(all.w * all.h));
    }
  }
}

TEST(TestPattern, TheLeftEyeIsRedAndTheRightEyeBlue) {
  const glm::ivec3 left = pixelAt(patternFor(TestPattern::eyes, desk(), Eye::left, {320, 200}), 20, 100);
  const glm::ivec3 right = pixelAt(patternFor(TestPattern::eyes, desk(), Eye::right, {320, 200}), 20, 100);
  EXPECT_GT(left.r, 2 * left.b);
  EXPECT_GT(right.b, 2 * right.r);
}

TEST(TestPattern, EveryPixelBelongsToTheEyeOfTheLayout) {
  for (const render::DisplayModeName& mode : render::kDisplayModes) {
    if (render::isAnaglyph(mode.mode) || mode.mode == DisplayMode::mono) continue;
    render::StereoLayout layout{.mode = mode.mode, .screen_px = {96, 72}, .at_px = {1, 2}};
    for (layout.output = 0; layout.output < render::outputCount(mode.mode); ++layout.output) {
      const Image all = patternOutput(TestPattern::eyes, desk(), layout);
      int wrong = 0;
      for (int y = 0; y < all.h; ++y)
        for (int x = 0; x < all.w; ++x) {
          const glm::ivec3 c = pixelAt(all, x, y);
          const render::PixelSource shown = render::sourcePixelAt(layout, {x, y}).eye;
          // White letters are in both; what has a hue must have the eye's own.
          if (c.r > c.b + 60) wrong += shown != render::PixelSource::left;
          if (c.b > c.r + 60) wrong += shown != render::PixelSource::right;
          if (shown == render::PixelSource::black) wrong += c != glm::ivec3(0);
        }
      EXPECT_EQ(wrong, 0) << mode.name;
    }
  }
}

TEST(TestPattern, AGridSquareHasTheStatedSize) {
  // A millimetre a pixel: lines of the 10 mm grid through the middle and every ten pixels.
  const Image grid = patternFor(TestPattern::grid, desk(), Eye::left, {320, 200});
  for (const int x : {110, 120, 130, 140, 150, 170, 180, 190})
    EXPECT_GT(pixelAt(grid, x, 75).r + pixelAt(grid, x - 1, 75).r, pixelAt(grid, x + 4, 75).r + 40) << x;
  // The same lines in half as many columns: pixels twice as wide change no size.
  const Image half = patternFor(TestPattern::grid, desk(), Eye::left, {160, 200});
  EXPECT_GT(pixelAt(half, 60, 75).r, pixelAt(half, 62, 75).r + 20);
}

TEST(TestPattern, ThePanelImageIsFlippedForAMirror) {
  const Image straight = patternFor(TestPattern::text, desk(), Eye::left, {320, 200});
  const Image panel = patternFor(TestPattern::text, throughMirror(), Eye::left, {320, 200});
  long difference = 0, to_itself = 0;
  for (int y = 0; y < 150; ++y)  // the words; lines of pixels are put on pixels' edges
    for (int x = 0; x < 320; ++x) {
      difference += std::abs(pixelAt(straight, x, y).r - pixelAt(panel, 319 - x, y).r);
      to_itself += std::abs(pixelAt(straight, x, y).r - pixelAt(panel, x, y).r);
    }
  EXPECT_LT(difference, to_itself / 10);
}

TEST(ScreenPage, TextWidthIsIndependentOfPixelShape) {
  const ScreenPage square(desk(), {320, 200}), halved(desk(), {160, 200}), fine(desk(), {1920, 1200});
  const double width = square.textWidth("lean the handle to the left", 13.5);
  EXPECT_NEAR(halved.textWidth("lean the handle to the left", 13.5), width, 0.01);
  EXPECT_NEAR(fine.textWidth("lean the handle to the left", 13.5), width, 0.01);
  EXPECT_NEAR(square.textWidth("lean the handle to the left", 27.0), 2.0 * width, 0.1);
}

// reference/rendering 5a: a point z before the screen, seen from D: disparity ipd z / (D - z); on the screen none.
TEST(TestPattern, DisparityOfCrossAndRingsIsCorrect) {
  const calibration::Rig rig = desk();
  const ScreenPage page(rig, {320, 200});
  const auto disparity = [&](double before_mm) {
    return page.seenAt(rig, Eye::left, {-30, 10}, before_mm).x - page.seenAt(rig, Eye::right, {-30, 10}, before_mm).x;
  };
  EXPECT_NEAR(disparity(0.0), 0.0, 1e-9);
  const double eye_distance = 500.0, ipd = rig.right_eye.mm.x - rig.left_eye.mm.x;
  EXPECT_NEAR(disparity(20.0), ipd * 20.0 / (eye_distance - 20.0), 1e-9);
  EXPECT_NEAR(disparity(-20.0), -ipd * 20.0 / (eye_distance + 20.0), 1e-9);
  EXPECT_EQ(patternFor(TestPattern::grid, rig, Eye::left, {64, 40}).rgba,
            patternFor(TestPattern::grid, rig, Eye::right, {64, 40}).rgba);
  EXPECT_NE(patternFor(TestPattern::cross, rig, Eye::left, {320, 200}).rgba,
            patternFor(TestPattern::cross, rig, Eye::right, {320, 200}).rgba);
}

}  // namespace
}  // namespace app
