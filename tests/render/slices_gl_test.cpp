// CT slices in the eye's image: exactly the pixels of the slice, at the same position in every back-end; nothing else
// changes.
#include <gtest/gtest.h>

#include <memory>

#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using testing::ballVolume;
using testing::frameFor;
using testing::smallGrid;

const glm::ivec2 kPx{200, 150};
constexpr int kEdge = 45, kLeft = 3;  // 0.3 and 0.025 of the height
constexpr std::array kTop{3, 52, 101};

class SlicesInTheImage : public ::testing::TestWithParam<Backend> {
 protected:
  const OffscreenContext context_;
  const assets::CtVolume ct_ = ballVolume(smallGrid(), {{{0.3, -0.2, 0.1}, 9.0}});
  const std::vector<std::int16_t> hounsfield_ = [&] {
    std::vector<std::int16_t> hounsfield;
    for (const std::uint8_t solid : ct_.solid) hounsfield.push_back(static_cast<std::int16_t>(8 * solid - 700));
    return hounsfield;
  }();

  std::unique_ptr<FrameRenderer> renderer(int samples = 1) const {
    auto made = std::make_unique<FrameRenderer>(ct_.grid, ct_.solid, ct_.label,
                                                RenderOptions{.backend = GetParam(), .samples = samples});
    made->setScan({hounsfield_, ct_.solid, {}, 1.0});
    return made;
  }
  static Frame frame(bool slices) {
    Frame made = frameFor(cameraRig({.eye_P_mm = {60, -200, 80}, .look_at_P_mm = {0, 0, 0}, .fov_y_rad = 0.17}, kPx));
    made.layers.slices = slices;
    made.X_PT.translation_mm = {2.0, -8.0, 1.0};
    return made;
  }
};

int worstBetween(const Image& shown, glm::ivec2 first, const Image& slice) {
  int worst = 0;
  for (int y = 0; y < slice.h; ++y)
    for (int x = 0; x < slice.w; ++x)
      for (int c = 0; c < 3; ++c) {
        const int there = shown.rgba[static_cast<std::size_t>(4 * ((first.y + y) * shown.w + first.x + x) + c)];
        worst = std::max(worst, std::abs(there - slice.rgba[static_cast<std::size_t>(4 * (y * slice.w + x) + c)]));
      }
  return worst;
}

TEST_P(SlicesInTheImage, AreThePixelsOfTheSlicesAndNothingElseChanges) {
  for (const int samples : {1, 2}) {
    const auto drawing = renderer(samples);
    const Frame with = frame(true);
    drawing->renderEye(frame(false), Eye::left);
    const Image plain = drawing->readEye(Eye::left);
    const DistanceImage plain_distance = drawing->readDistance(Eye::left);
    drawing->renderEye(with, Eye::left);
    const Image shown = drawing->readEye(Eye::left);
    EXPECT_EQ(drawing->readDistance(Eye::left).mm, plain_distance.mm);
    for (std::size_t n = 0; n < 3; ++n)
      // Resolution of half floats near white.
      EXPECT_LE(worstBetween(shown, {kLeft, kTop[n]}, drawing->slice(kSlicePlanes[n], with, kEdge)), 2) << n;
    for (int y = 0; y < kPx.y; ++y)
      for (int x = kLeft + kEdge; x < kPx.x; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = 4 * static_cast<std::size_t>(y * kPx.x + x) + c;
          ASSERT_EQ(shown.rgba[at], plain.rgba[at]) << x << " " << y;
        }
    drawing->renderEye(frame(false), Eye::left);
    EXPECT_EQ(drawing->readEye(Eye::left).rgba, plain.rgba);  // and they can be removed
  }
}

TEST_P(SlicesInTheImage, HaveTheSamePositionInBothEyes) {
  const auto drawing = renderer();
  Frame with = frame(true);
  with.rig.left_eye.mm.x -= 30.0;
  with.rig.right_eye.mm.x += 30.0;
  for (const Eye eye : {Eye::left, Eye::right}) {
    drawing->renderEye(with, eye);
    EXPECT_LE(worstBetween(drawing->readEye(eye), {kLeft, kTop[0]}, drawing->slice(SlicePlane::axial, with, kEdge)), 2);
  }
}

TEST_P(SlicesInTheImage, AreUprightForTheViewerThroughAMirror) {
  const auto drawing = renderer();
  Frame direct = frame(true);
  direct.rig.left_eye.mm.x -= 30.0;
  direct.rig.right_eye.mm.x += 30.0;
  Frame mirrored = direct;
  mirrored.rig = testing::throughMirror(direct.rig);
  drawing->renderEye(direct, Eye::left);
  const Image seen = drawing->readEye(Eye::left);
  drawing->renderEye(mirrored, Eye::left);
  const Image on_panel = drawing->readEye(Eye::left);
  // The panel's image, flipped by the mirror, equals the direct one.
  int differ = 0;
  for (int y = 0; y < kPx.y; ++y)
    for (int x = 0; x < kEdge; ++x) {
      const auto at = [](const Image& image, int px, int py) {
        return int{image.rgba[4 * static_cast<std::size_t>(py * kPx.x + px)]};
      };
      differ += std::abs(at(seen, x, y) - at(on_panel, kPx.x - 1 - x, y)) > 2;
    }
  EXPECT_LT(differ, 30);
}

INSTANTIATE_TEST_SUITE_P(Backends, SlicesInTheImage, ::testing::Values(Backend::gl_fragment, Backend::cpu),
                         [](const auto& given) { return given.param == Backend::cpu ? "Cpu" : "Gl"; });

}  // namespace
}  // namespace render
