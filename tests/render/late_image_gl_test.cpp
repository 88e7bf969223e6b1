// A picture read back without waiting: the one that was asked for, whatever is drawn meanwhile.
#include <gtest/gtest.h>

#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using testing::ballVolume;
using testing::frameFor;
using testing::Random;
using testing::randomRig;
using testing::smallGrid;

std::optional<Image> awaited(FrameRenderer& renderer, glm::ivec2 most_px, std::optional<Eye> eye) {
  // The next frame has it; a rasteriser in software may take some.
  for (int n = 0; n < 10'000; ++n)
    if (auto image = renderer.readLate(most_px, eye)) return image;
  return {};
}

TEST(LateImage, IsThatOfTheFrameItWasAskedFor) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(glm::ivec3(64), 0.5), {{{0, 0, 0}, 9.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Random random(7);
  for (const bool is_eye : {false, true}) {
    const auto eye = is_eye ? std::optional(Eye::cyclopean) : std::nullopt;
    Frame frame = frameFor(randomRig(random, false));
    renderer.render(frame);
    const Image at_once = is_eye ? renderer.readEye(Eye::cyclopean) : renderer.readImage();
    const glm::ivec2 whole{at_once.w, at_once.h};
    EXPECT_FALSE(renderer.readLate(whole, eye)) << "it is on its way";
    frame.rig = randomRig(random, false);
    frame.rig.screen.px = whole;
    renderer.render(frame);
    const auto late = awaited(renderer, whole, eye);
    ASSERT_TRUE(late);
    EXPECT_EQ(late->rgba, at_once.rgba);
    // And small: each point is one of those that it stands for.
    EXPECT_FALSE(renderer.readLate(whole / 2, eye));
    const auto small = awaited(renderer, whole / 2, eye);
    ASSERT_TRUE(small);
    EXPECT_LE(small->w, whole.x / 2);
    EXPECT_LE(small->h, whole.y / 2);
  }
}

}  // namespace
}  // namespace render
