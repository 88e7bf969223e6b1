#include "app/calibrate/wizard_pages.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using calibration::Point;
using calibration::Rig;
using calibration::World;
using render::DisplayMode;
using render::Eye;
using render::Image;

constexpr glm::ivec2 kPx{960, 540};

/// A 24-inch screen, seen straight on or by a panel behind a mirror that shows it at the same place.
Rig desk() { return calibration::desktopRig({1920, 1080}, 531.0); }
Rig throughMirror() {
  Rig rig = desk();
  const calibration::ScreenCorners seen = rig.screen;
  rig.mirror = calibration::Plane<World>{glm::normalize(glm::dvec3(0.0, 0.7, 0.7)), 40.0};
  rig.screen.lower_left = rig.mirror->reflect(seen.lower_right);
  rig.screen.lower_right = rig.mirror->reflect(seen.lower_left);
  rig.screen.upper_left = rig.mirror->reflect({seen.lower_right.mm + seen.upper_left.mm - seen.lower_left.mm});
  return rig;
}

WizardView viewThrough(const Rig& rig) {
  WizardView view;
  view.screen = rig.screen;
  view.left_eye = rig.left_eye;
  view.right_eye = rig.right_eye;
  return view;
}

WizardView touching(const Rig& rig) {
  WizardView view = viewThrough(rig);
  view.title = "Touch the pits";
  view.sentence = "Put the tip into the glowing pit and hold still";
  view.button = {"take the touch now", "undo the last touch", "takes the touch by itself"};
  view.message = {"touch 11 taken", Tone::good};
  view.count = "12 of 27";
  view.progress = 12.0 / 27.0;
  view.time_left_s = 81.0;
  view.capture = 0.6;
  int n = 0;
  for (const double z : {-25.0, 0.0, 25.0})
    for (const double y : {-35.0, 0.0, 35.0})
      for (const double x : {-60.0, 0.0, 60.0}) {
        const TargetState state = n < 11 ? TargetState::done : n == 11 ? TargetState::next : TargetState::pending;
        view.targets.push_back({{{x, y, z}}, {{0.0, 0.5, 0.8660254}}, n == 5 ? TargetState::doubtful : state, "1"});
        ++n;
      }
  view.tilt = TiltCue{{{-0.42, 0.3, 0.8567}}, {{0.1, 0.5, 0.86}}, 32.0, false, "lean it 30° to the left"};
  view.tip_W = Point<World>{{-55.0, -2.0, 5.0}};
  return view;
}

glm::ivec3 pixelAt(const Image& picture, glm::ivec2 px) {
  const std::uint8_t* c = picture.rgba.data() + 4 * (px.y * picture.w + px.x);
  return {c[0], c[1], c[2]};
}
int light(const glm::ivec3& c) { return c.r + c.g + c.b; }

/// Where OpenGL's clip space has a point, in px from the top left: what everything else is drawn by.
glm::dvec2 projected(const Rig& rig, Eye eye, const glm::dvec3& p_W, glm::ivec2 px) {
  const glm::dvec4 clip = render::eyeView(rig, eye).clip_from_W * glm::dvec4(p_W, 1.0);
  return {(0.5 + 0.5 * clip.x / clip.w) * px.x, (0.5 - 0.5 * clip.y / clip.w) * px.y};
}

/// Middle of all that is brighter with the target than without it.
glm::dvec2 middleOfChange(const Image& with, const Image& without) {
  glm::dvec2 sum{0.0};
  double weight = 0.0;
  for (int y = 0; y < with.h; ++y)
    for (int x = 0; x < with.w; ++x) {
      const double more = std::abs(light(pixelAt(with, {x, y})) - light(pixelAt(without, {x, y})));
      sum += more * (glm::dvec2(x, y) + 0.5);
      weight += more;
    }
  return sum / weight;
}

TEST(WizardPages, ATargetIsWhereEachEyeHasToSeeIt) {
  for (const Rig& rig : {desk(), throughMirror()})
    for (const Eye eye : {Eye::left, Eye::right, Eye::cyclopean})
      for (const glm::dvec3 place : {glm::dvec3(0.0), glm::dvec3(40.0, 25.0, 30.0), glm::dvec3(-50.0, -30.0, -30.0)}) {
        WizardPages pages(rig.mirror);
        WizardView view = viewThrough(rig);
        const Image without = pages.page(view, std::nullopt, eye, kPx, 0.6);
        view.target_kind = calibration::TargetKind::webcam_place;
        view.targets.push_back({{place}, {{0.0, 0.0, 1.0}}, TargetState::next, "1"});
        const glm::dvec2 is = middleOfChange(pages.page(view, std::nullopt, eye, kPx, 0.6), without);
        EXPECT_LT(glm::distance(is, projected(rig, eye, place, kPx)), 0.1);
      }
}

TEST(WizardPages, ACrossOfTheScreensPlaneHasNoDisparityAndAPitBeforeItHas) {
  const Rig rig = desk();
  WizardPages pages(rig.mirror);
  WizardView view = viewThrough(rig);
  view.target_kind = calibration::TargetKind::cross;
  view.zero_parallax = true;
  view.targets.push_back({{{20.0, 10.0, 3.0}}, {{0.0, 0.0, 1.0}}, TargetState::next, "1"});
  EXPECT_EQ(pages.page(view, std::nullopt, Eye::left, kPx, 0.0).rgba,
            pages.page(view, std::nullopt, Eye::right, kPx, 0.0).rgba);
  view.target_kind = calibration::TargetKind::pit;
  view.zero_parallax = false;
  EXPECT_NE(pages.page(view, std::nullopt, Eye::left, kPx, 0.0).rgba,
            pages.page(view, std::nullopt, Eye::right, kPx, 0.0).rgba);
}

TEST(WizardPages, ThroughAMirrorThePanelShowsThePageTurnedSoThatItReadsRight) {
  const auto pageOf = [](const Rig& rig) {
    WizardPages pages(rig.mirror);
    return pages.page(touching(rig), std::nullopt, Eye::left, kPx, 0.0);
  };
  const Image straight = pageOf(desk()), panel = pageOf(throughMirror());
  long turned = 0, same = 0;
  for (int y = 0; y < kPx.y; ++y)
    for (int x = 0; x < kPx.x; ++x) {
      const int is = light(pixelAt(straight, {x, y}));
      turned += std::abs(is - light(pixelAt(panel, {kPx.x - 1 - x, y})));
      same += std::abs(is - light(pixelAt(panel, {x, y})));
    }
  EXPECT_LT(turned, same / 20);
}

TEST(WizardPages, TheBarIsAsLongOnTheVirtualScreenAsItSays) {
  const Rig rig = desk();
  WizardPages pages(rig.mirror);
  WizardView view = viewThrough(rig);
  view.figure = WizardFigure::length_bar;
  view.bar_mm = 100.0;
  const Image picture = pages.page(view, std::nullopt, Eye::left, {1920, 1080}, 0.0);
  // End marks, 10 mm above the bar itself.
  int first = -1, last = -1;
  for (int x = 0; x < 1920; ++x)
    if (light(pixelAt(picture, {x, 540 - 36})) > 300) {
      if (first < 0) first = x;
      last = x;
    }
  EXPECT_NEAR((last - first) * 531.0 / 1920.0, 100.0, 0.7);
}

TEST(WizardPages, TheFIsNoMirrorImage) {
  const Rig rig = desk();
  WizardPages pages(rig.mirror);
  WizardView view = viewThrough(rig);
  view.figure = WizardFigure::letter_f;
  const Image picture = pages.page(view, std::nullopt, Eye::left, {531, 299}, 0.0);
  const auto isLit = [&](int right_mm, int up_mm) {
    return light(pixelAt(picture, {265 + right_mm, 149 - up_mm})) > 300;
  };
  EXPECT_TRUE(isLit(-15, 30) && isLit(-15, -30));  // the stem, left
  EXPECT_TRUE(isLit(20, 33));                      // the upper bar, right
  EXPECT_FALSE(isLit(20, -33) || isLit(-35, 33));
}

TEST(WizardPages, LettersAreAtLeastEightMillimetresHigh) {
  const Rig rig = desk();
  WizardPages pages(rig.mirror);
  WizardView view = viewThrough(rig);
  view.title = "HHHH";
  const Image picture = pages.page(view, std::nullopt, Eye::left, {1920, 1080}, 0.0);
  int top = 1080, bottom = -1;
  for (int y = 0; y < 1080; ++y)
    for (int x = 0; x < 300; ++x)
      if (light(pixelAt(picture, {x, y})) > 250) top = std::min(top, y), bottom = std::max(bottom, y);
  EXPECT_GE((bottom - top + 1) * 531.0 / 1920.0, 8.0);
}

TEST(WizardPages, EveryModeGetsAPictureOfItsSize) {
  const Rig rig = desk();
  WizardPages pages(rig.mirror);
  for (const render::DisplayModeName& mode : render::kDisplayModes) {
    const render::StereoLayout layout{.mode = mode.mode, .screen_px = {192, 108}};
    const Image all = pages.output(touching(rig), std::nullopt, layout, 0.0);
    EXPECT_EQ(glm::ivec2(all.w, all.h), render::outputSize(mode.mode, {192, 108})) << mode.name;
    EXPECT_EQ(all.rgba.size(), 4u * static_cast<std::size_t>(all.w * all.h)) << mode.name;
  }
}

TEST(WizardPages, WhatIsDrawnAfterAnotherPageIsAsIfItHadBeenTheFirst) {
  const Rig rig = desk();
  WizardPages used(rig.mirror), fresh(rig.mirror);
  WizardView other = touching(rig);
  other.sentence = "Something else";
  used.page(other, std::nullopt, Eye::right, kPx, 0.3);
  EXPECT_EQ(used.page(touching(rig), std::nullopt, Eye::left, kPx, 0.0).rgba,
            fresh.page(touching(rig), std::nullopt, Eye::left, kPx, 0.0).rgba);
}

TEST(PatternForCamera, IsShownPixelByPixelToBothEyes) {
  calibration::GreyImage pattern{{64, 48}, {}};
  for (int n = 0; n < 64 * 48; ++n) pattern.grey.push_back(static_cast<std::uint8_t>(n % 251));
  const Image mono = patternForCamera(pattern, {.mode = DisplayMode::mono, .screen_px = {64, 48}});
  EXPECT_EQ(pixelAt(mono, {5, 7}), glm::ivec3((7 * 64 + 5) % 251));
  const Image halves = patternForCamera(pattern, {.mode = DisplayMode::side_by_side, .screen_px = {64, 48}});
  EXPECT_EQ(pixelAt(halves, {5, 7}), glm::ivec3((7 * 64 + 10) % 251));
  EXPECT_EQ(pixelAt(halves, {32 + 5, 7}), pixelAt(halves, {5, 7}));
}

}  // namespace
}  // namespace app
