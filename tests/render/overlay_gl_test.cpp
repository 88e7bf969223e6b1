// The overlay over composed images: blended in every mode by every back-end, and nothing else of the picture changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using testing::ballVolume;
using testing::frameFor;
using testing::smallGrid;

constexpr glm::ivec2 kPx{160, 120};

OverlayPanel panelOf(glm::ivec2 corner_px, glm::ivec2 size_px, unsigned shade) {
  OverlayPanel panel{{size_px.x, size_px.y, {}}, corner_px, 1 + shade + 1000 * static_cast<unsigned>(size_px.x)};
  for (int p = 0; p < size_px.x * size_px.y; ++p) {
    const unsigned alpha = 60 + static_cast<unsigned>(p % 190);
    for (const unsigned part : {3u, 2u, 1u})
      panel.image.rgba.push_back(static_cast<std::uint8_t>(alpha * ((shade + part * 70) % 256) / 255));
    panel.image.rgba.push_back(static_cast<std::uint8_t>(alpha));
  }
  return panel;
}

class OverlayOnTheImage : public ::testing::TestWithParam<Backend> {
 protected:
  const OffscreenContext context_;
  const assets::CtVolume ct_ = ballVolume(smallGrid(), {{{0.3, -0.2, 0.1}, 9.0}});

  std::unique_ptr<FrameRenderer> renderer() const {
    return std::make_unique<FrameRenderer>(ct_.grid, ct_.solid, ct_.label, RenderOptions{.backend = GetParam()});
  }
  static Frame frame(DisplayMode mode) {
    Frame made = frameFor(cameraRig({.eye_P_mm = {60, -200, 80}, .look_at_P_mm = {0, 0, 0}, .fov_y_rad = 0.17}, kPx));
    made.display = mode;
    return made;
  }
};

/// The picture without overlay, with the patches blended in double.
std::vector<double> blended(const Image& plain, const std::vector<OverlayPatch>& patches) {
  std::vector<double> light(plain.rgba.begin(), plain.rgba.end());
  for (const OverlayPatch& patch : patches)
    for (const glm::ivec2& corner : patch.corners_px)
      for (int y = 0; y < patch.image.h; ++y)
        for (int x = 0; x < patch.image.w; ++x)
          for (std::size_t c = 0; c < 3; ++c) {
            const std::uint8_t* from = &patch.image.rgba[static_cast<std::size_t>(4 * (y * patch.image.w + x))];
            double& to = light[static_cast<std::size_t>(4 * ((corner.y + y) * plain.w + corner.x + x)) + c];
            to = from[c] + to * (1.0 - from[3] / 255.0);
          }
  return light;
}

double worstDifference(const Image& shown, const std::vector<double>& expected) {
  double worst = 0.0;
  for (std::size_t n = 0; n < shown.rgba.size(); ++n)
    if (n % 4 != 3) worst = std::max(worst, std::abs(shown.rgba[n] - expected[n]));
  return worst;
}

TEST_P(OverlayOnTheImage, IsBlendedOverBothEyesInEveryMode) {
  const auto drawing = renderer();
  const std::vector<OverlayPanel> panels{panelOf({5, 100}, {90, 15}, 0), panelOf({70, 60}, {40, 44}, 40)};
  for (const DisplayModeName& known : kDisplayModes) {
    const Frame shown = frame(known.mode);
    StereoLayout layout{.mode = known.mode, .screen_px = kPx};
    std::vector<OverlayPatch> patches;
    for (const OverlayPanel& panel : panels) patches.push_back(patchOf(panel, layout, screenOrientation(shown.rig)));
    drawing->setOverlay({});
    drawing->render(shown);
    std::vector<Image> plain;
    for (int output = 0; output < outputCount(known.mode); ++output) plain.push_back(drawing->readImage(output));
    drawing->setOverlay(panels);
    drawing->render(shown);
    for (int output = 0; output < outputCount(known.mode); ++output)
      // Each blend is rounded to a byte.
      EXPECT_LE(worstDifference(drawing->readImage(output), blended(plain[static_cast<std::size_t>(output)], patches)),
                1.1)
          << known.name;
  }
}

TEST_P(OverlayOnTheImage, FollowsChangesOfAPanelAndIsNotInAnEyeReadAlone) {
  const auto drawing = renderer();
  const Frame mono = frame(DisplayMode::mono);
  drawing->render(mono);
  const Image plain = drawing->readImage();
  drawing->setOverlay({panelOf({10, 10}, {30, 12}, 0)});
  drawing->render(mono);
  const Image first = drawing->readImage();
  EXPECT_NE(first.rgba, plain.rgba);
  EXPECT_EQ(drawing->readEye(Eye::cyclopean).rgba, plain.rgba);

  drawing->setOverlay({panelOf({10, 10}, {30, 12}, 90)});  // other colours
  drawing->render(mono);
  EXPECT_NE(drawing->readImage().rgba, first.rgba);
  drawing->setOverlay({panelOf({10, 10}, {20, 12}, 0)});  // another size
  drawing->render(mono);
  EXPECT_NE(drawing->readImage().rgba, first.rgba);
  drawing->setOverlay({panelOf({10, 10}, {30, 12}, 0)});
  drawing->render(mono);
  EXPECT_EQ(drawing->readImage().rgba, first.rgba);
  drawing->setOverlay({});
  drawing->render(mono);
  EXPECT_EQ(drawing->readImage().rgba, plain.rgba);
}

// The same viewer's pixels, through a panel whose image is flipped by a mirror.
TEST_P(OverlayOnTheImage, IsUprightForTheViewerThroughTheMirror) {
  const auto drawing = renderer();
  Frame direct = frame(DisplayMode::mono), mirrored = direct;
  mirrored.rig = testing::throughMirror(direct.rig);
  drawing->setOverlay({panelOf({5, 100}, {90, 15}, 0)});
  drawing->render(direct);
  const Image seen = drawing->readImage();
  drawing->render(mirrored);
  const Image on_panel = drawing->readImage();
  int worst = 0;
  for (int y = 100; y < 115; ++y)
    for (int x = 5; x < 95; ++x)
      for (int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(seen.rgba[static_cast<std::size_t>(4 * (y * kPx.x + x) + c)] -
                                         on_panel.rgba[static_cast<std::size_t>(4 * (y * kPx.x + kPx.x - 1 - x) + c)]));
  EXPECT_LE(worst, 2);
}

INSTANTIATE_TEST_SUITE_P(Backends, OverlayOnTheImage, ::testing::Values(Backend::gl_fragment, Backend::cpu),
                         [](const auto& given) { return given.param == Backend::cpu ? "Cpu" : "Gl"; });

}  // namespace
}  // namespace render
