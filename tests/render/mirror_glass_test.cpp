// The view in the glass of the second hand's mirror as uniforms, and the pixels that can show it.
#include <gtest/gtest.h>

#include "render/eye_block.h"
#include "tests/render/ball_volume.h"

namespace render {
namespace {

using testing::Random;
using testing::randomRig;

constexpr double kRadius_mm = 11.0;

/// Somewhere near the patient; faces any way.
Frame held(Random& random, bool mirrored) {
  Frame frame;
  frame.rig = randomRig(random, mirrored);
  frame.second_visible = true;
  frame.second_glass = MirrorGlass{random.direction(), kRadius_mm, 0.25};
  frame.X_PO = {glm::angleAxis(random.between(0.0, 6.0), random.direction()), random.inCube(60.0)};
  return frame;
}

glm::dvec3 eyeOf_P(const Frame& frame, const EyeView& view) { return (frame.rig.X_WP.inverse() * view.eye_W).mm; }

TEST(MirrorGlass, ReflectsWhereTheEyeIsBeforeItAndNowhereElse) {
  Random random(21);
  int before = 0;
  for (int n = 0; n < 2000; ++n) {
    const Frame frame = held(random, n % 2 == 1);
    const EyeView view = eyeView(frame.rig, Eye::left);
    const glm::dvec3 out = frame.X_PO.rotation * frame.second_glass->out_O;
    const bool is_before = glm::dot(eyeOf_P(frame, view) - frame.X_PO.translation_mm, out) > 0.05;
    before += is_before ? 1 : 0;
    ASSERT_EQ(reflectedEyeBlock(frame, view).has_value(), is_before);
    ASSERT_EQ(eyeBlock(frame, view).glass.x > 0.0f, is_before);
    Frame without = frame;
    without.second_glass.reset();
    ASSERT_FALSE(reflectedEyeBlock(without, view));
    without = frame;
    without.second_visible = false;
    ASSERT_EQ(eyeBlock(without, view).glass.x, 0.0f);
  }
  EXPECT_GT(before, 500);
  EXPECT_LT(before, 1500);
}

TEST(MirrorGlass, RaysBeginJustBeforeTheGlassUnderTheSameLampAndWindow) {
  Random random(22);
  for (int n = 0; n < 2000; ++n) {
    const Frame frame = held(random, n % 2 == 1);
    const EyeView view = eyeView(frame.rig, Eye::right);
    const auto there = reflectedEyeBlock(frame, view);
    if (!there) continue;
    const EyeBlock eye = eyeBlock(frame, view);
    EXPECT_EQ(there->lamp_P, eye.lamp_P);
    EXPECT_EQ(there->window_eye_P, eye.window_eye_P);
    EXPECT_EQ(there->glass.x, 0.0f) << "no mirror in the mirror";
    EXPECT_EQ(eye.begin_P, glm::vec4(0.0f)) << "straight rays begin at the eye";

    // rayBegin() of eye_block.glsl, through a place of the glass.
    const glm::dvec3 out(there->begin_P), eye_P(there->eye_P);
    const glm::dvec3 across = glm::normalize(glm::cross(out, random.direction()));
    const glm::dvec3 way = glm::normalize(frame.X_PO.translation_mm + random.between(0.0, 10.0) * across - eye_P);
    const glm::dvec3 begin = eye_P + static_cast<double>(there->begin_P.w) / glm::dot(way, out) * way;
    EXPECT_NEAR(glm::dot(begin - frame.X_PO.translation_mm, out), 0.05, 2e-3);
  }
}

TEST(MirrorGlass, EveryPixelThatShowsItIsInItsBox) {
  Random random(23);
  constexpr glm::ivec2 kPx{320, 240};
  int seen = 0, small = 0;
  for (int n = 0; n < 2000; ++n) {
    const Frame frame = held(random, n % 2 == 1);
    const EyeView view = eyeView(frame.rig, Eye::left);
    const GlassBox box = glassBox(frame, view, kPx);
    if (!reflectedEyeBlock(frame, view)) {
      ASSERT_EQ(box.size_px, glm::ivec2(0));
      continue;
    }
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(box.corner_px, glm::ivec2(0))));
    ASSERT_TRUE(glm::all(glm::lessThanEqual(box.corner_px + box.size_px, kPx)));
    small += box.size_px.x > 0 && 4 * box.size_px.x * box.size_px.y < kPx.x * kPx.y ? 1 : 0;
    const glm::dvec3 out = frame.X_PO.rotation * frame.second_glass->out_O;
    for (int m = 0; m < 20; ++m) {
      const glm::dvec3 across = glm::normalize(glm::cross(out, random.direction()));
      const glm::dvec3 place = frame.X_PO.translation_mm + random.between(0.0, kRadius_mm) * across;
      const auto place_W = frame.rig.X_WP * calibration::Point<calibration::Patient>{place};
      const glm::dvec4 clip = view.clip_from_W * glm::dvec4(place_W.mm, 1.0);
      const glm::dvec2 px = (0.5 + 0.5 * glm::dvec2(clip) / clip.w) * glm::dvec2(kPx);
      if (clip.w <= 0.0 || px.x < 0.0 || px.y < 0.0 || px.x >= kPx.x || px.y >= kPx.y) continue;
      ++seen;
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(px + 1e-9, glm::dvec2(box.corner_px))));
      ASSERT_TRUE(glm::all(glm::lessThanEqual(px - 1e-9, glm::dvec2(box.corner_px + box.size_px))));
    }
  }
  EXPECT_GT(seen, 2000);
  EXPECT_GT(small, 300);
}

}  // namespace
}  // namespace render
