// What is seen in the glass of the second hand's mirror, in OpenGL and on the CPU.
#include <gtest/gtest.h>

#include <cmath>

#include "assets/instrument/dental_mirror.h"
#include "assets/instrument/handpiece.h"
#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/twin_scene.h"

namespace render {
namespace {

using namespace render::testing;

constexpr glm::ivec2 kPx{160, 120};
const MirrorGlass kGlass{assets::mirrorGlassNormal(), assets::kMirrorGlassRadius_mm};

/// The glass at the origin, out towards an eye at -y and turned from there to +x.
calibration::Pose<calibration::Patient, calibration::OtherTool> turnedBy(double angle_rad) {
  return {glm::angleAxis(angle_rad, glm::dvec3(0, 0, 1)) * glm::angleAxis(M_PI / 4.0, glm::dvec3(1, 0, 0)), {0, 0, 0}};
}

/// A bone beside the mirror, and a green and a red ball.
class MirrorGlassScene : public ::testing::TestWithParam<Backend> {
 protected:
  OffscreenContext context_;
  assets::CtVolume ct_ = ballVolume(smallGrid(), {{{12, -2, -5}, 3.5}});
  Frame frame_ = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, kPx));

  MirrorGlassScene() {
    frame_.second_visible = true;
    frame_.second_glass = kGlass;
    frame_.X_PO = turnedBy(M_PI / 4.0);
  }
  std::unique_ptr<FrameRenderer> opened(RenderOptions options) const {
    auto renderer = std::make_unique<FrameRenderer>(ct_.grid, ct_.solid, ct_.label, options);
    renderer->setGingiva({{ballMesh({13, -4, 3}, 1.5f, {0.05f, 0.8f, 0.05f, 1.0f})}});
    renderer->setFace({{ballMesh({13, 3, 3}, 1.5f, {0.8f, 0.05f, 0.05f, 1.0f})}});
    renderer->setInstrument(assets::surgicalHandpiece({}));
    renderer->setSecondInstrument(assets::dentalMirror());
    return renderer;
  }
  std::unique_ptr<FrameRenderer> opened() const { return opened({.backend = GetParam()}); }
  Image drawn(FrameRenderer& renderer) const {
    renderer.renderEye(frame_, Eye::cyclopean);
    return renderer.readEye(Eye::cyclopean);
  }
  EyeView view() const { return eyeView(frame_.rig, Eye::cyclopean); }
  glm::dvec2 pixelOfImage(const glm::dvec3& p_P) const {
    const glm::dvec3 n = frame_.X_PO.rotation * assets::mirrorGlassNormal();
    return pixelOf(frame_.rig, view(), p_P - 2.0 * glm::dot(p_P, n) * n);
  }
};

/// Middle of the pixels left of `end_x` in which one channel is by far the brightest; none: NaN.
glm::dvec2 middleOf(const Image& image, std::size_t channel, int end_x) {
  glm::dvec2 sum(0.0);
  double count = 0.0;
  for (int y = 0; y < image.h; ++y)
    for (int x = 0; x < end_x; ++x) {
      const std::uint8_t* const p = &image.rgba[4 * static_cast<std::size_t>(y * image.w + x)];
      const int other = std::max(p[channel == 0 ? 1 : 0], p[2]);
      if (p[channel] < other + 40) continue;
      sum += glm::dvec2(x + 0.5, y + 0.5);
      count += 1.0;
    }
  return sum / count;
}

TEST_P(MirrorGlassScene, ShowsEveryThingWhereItsMirrorImageIs) {
  const auto renderer = opened();
  const Image image = drawn(*renderer);
  const int beside = 110;  // right of it the balls are seen straight
  const glm::dvec2 green = middleOf(image, 1, beside), red = middleOf(image, 0, beside);
  EXPECT_LT(glm::distance(green, pixelOfImage({13, -4, 3})), 0.6);
  EXPECT_LT(glm::distance(red, pixelOfImage({13, 3, 3})), 0.6);

  // Straight from the mirror's place, upright, the red ball is left of the green one; in the glass it is right of it.
  Frame from_there = frame_;
  from_there.rig = cameraRig({.eye_P_mm = {-150, 0, 3}, .look_at_P_mm = {13, 0, 3}, .fov_y_rad = 0.17}, kPx);
  from_there.second_visible = false;
  renderer->renderEye(from_there, Eye::cyclopean);
  const Image straight = renderer->readEye(Eye::cyclopean);
  EXPECT_LT(middleOf(straight, 0, kPx.x).x, middleOf(straight, 1, kPx.x).x);
  EXPECT_GT(red.x, green.x);
}

TEST_P(MirrorGlassScene, ShowsBoneAndTheInstrumentToo) {
  const auto renderer = opened();
  const auto bone = static_cast<glm::ivec2>(pixelOfImage({12, -2, -5}));
  const auto brightness = [&bone](const Image& image) {
    const std::uint8_t* const p = &image.rgba[4 * static_cast<std::size_t>(bone.y * image.w + bone.x)];
    return p[0] + p[1] + p[2];
  };
  const Image image = drawn(*renderer);
  EXPECT_GT(brightness(image), 200);
  frame_.tool_visible = true;
  frame_.X_PT.translation_mm = {6, 1, -3};
  EXPECT_GT(pixelsThatDiffer(image, drawn(*renderer), 20), 30u);
}

TEST_P(MirrorGlassScene, ChangesNoPixelWhereThereIsNoMirrorOrItShowsItsBack) {
  const auto renderer = opened();
  const auto same = [&](const char* what) {
    frame_.second_glass = kGlass;
    const Image with = drawn(*renderer);
    frame_.second_glass.reset();
    EXPECT_EQ(pixelsThatDiffer(with, drawn(*renderer)), 0u) << what;
  };
  frame_.X_PO = turnedBy(M_PI);
  same("its back");
  frame_.X_PO = turnedBy(0.75 * M_PI);
  same("aslant");
  frame_.X_PO.translation_mm.x = 200.0;
  same("beside the picture");
  frame_.X_PO = turnedBy(M_PI / 4.0);
  frame_.second_visible = false;
  same("not there");
  frame_.second_visible = true;
  frame_.second_glass = kGlass;
  const Image with = drawn(*renderer);
  frame_.second_glass.reset();
  EXPECT_GT(pixelsThatDiffer(with, drawn(*renderer), 8), 500u);
}

TEST_P(MirrorGlassScene, ShowsOnlyWhatLiesBeforeTheGlass) {
  // Right behind it, and between it and the reflected eye: neither a mesh nor bone.
  const auto plain = opened();
  const Image before = drawn(*plain);
  ct_ = ballVolume(smallGrid(), {{{12, -2, -5}, 3.5}, {{-9, 4, 3}, 3.0}});
  const auto renderer = opened();
  renderer->setFace(
      {{ballMesh({13, 3, 3}, 1.5f, {0.8f, 0.05f, 0.05f, 1.0f}), ballMesh({-7, 6, -4}, 3.0f, glm::vec4(1.0f))}});
  const Image after = drawn(*renderer);
  // Ambient shade of the new ball reaches a little way.
  for (int y = 40; y < 80; ++y)
    for (int x = 64; x < 92; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = 4 * static_cast<std::size_t>(y * kPx.x + x) + c;
        ASSERT_NEAR(after.rgba[at], before.rgba[at], 6) << x << ' ' << y;
      }
}

TEST_P(MirrorGlassScene, FogIsAVeilOverItAndNowhereElse) {
  const auto renderer = opened();
  const Image clear = drawn(*renderer);
  frame_.second_glass->fog = 1.0;
  const Image fogged = drawn(*renderer);
  std::size_t changed = 0;
  for (std::size_t p = 0; p < clear.rgba.size(); p += 4) {
    if (std::equal(&clear.rgba[p], &clear.rgba[p + 3], &fogged.rgba[p])) continue;
    ++changed;
    // 0.93 of 0.42, 0.45, 0.48, as sRGB.
    EXPECT_NEAR(fogged.rgba[p], 167, 1);
    EXPECT_NEAR(fogged.rgba[p + 1], 172, 1);
    EXPECT_NEAR(fogged.rgba[p + 2], 177, 1);
  }
  EXPECT_GT(changed, 500u);
  frame_.second_glass->fog = 0.5;
  const Image half = drawn(*renderer);
  EXPECT_GT(pixelsThatDiffer(clear, half, 8), 500u);
  EXPECT_GT(pixelsThatDiffer(fogged, half, 8), 500u);
}

INSTANTIATE_TEST_SUITE_P(BackEnds, MirrorGlassScene,
                         ::testing::Values(Backend::gl_fragment, Backend::gl_compute, Backend::cpu),
                         [](const auto& backend) {
                           return backend.param == Backend::cpu          ? "Cpu"
                                  : backend.param == Backend::gl_compute ? "Compute"
                                                                         : "Fragment";
                         });

class MirrorGlassTwin : public MirrorGlassScene {};

TEST_P(MirrorGlassTwin, IsTheSameInOpenGLAndOnTheCpu) {
  for (const int samples : {1, 2}) {
    const auto gl = opened({.backend = GetParam(), .samples = samples});
    const auto cpu = opened({.backend = Backend::cpu, .samples = samples});
    frame_.tool_visible = true;
    frame_.X_PT.translation_mm = {8, 1, -3};
    frame_.second_glass->fog = 0.2;
    const auto agree = [&](const char* what, const Frame& frame, int rims) {
      for (const Eye eye : {Eye::left, Eye::right}) {
        const Difference d = between(*gl, *cpu, frame, eye);
        EXPECT_LE(d.beyond, rims) << what;
        EXPECT_LE(d.worst_mm, 0.01) << what;
        EXPECT_LE(d.other_mm, 6) << what;
      }
    };
    agree("plain", frame_, 3);
    Frame f = frame_;
    f.rig = throughMirror(f.rig);
    agree("behind a half-silvered mirror", f, 15);
    f = frame_;
    f.mode = ViewMode::dvr;
    agree("translucent", f, 3);
    f = frame_;
    f.layers.face_opacity = 0.5f;
    agree("face faded", f, 3);
    f = frame_;
    f.quality.antialias = Antialias::edges;
    agree("edges", f, 4);
  }
}
INSTANTIATE_TEST_SUITE_P(BackEnds, MirrorGlassTwin, ::testing::Values(Backend::gl_fragment, Backend::gl_compute),
                         [](const auto& backend) {
                           return backend.param == Backend::gl_compute ? "Compute" : "Fragment";
                         });

TEST_P(MirrorGlassScene, SilhouettesInTheGlassAreSmoothed) {
  const auto renderer = opened();
  const Image plain = drawn(*renderer);
  frame_.quality.antialias = Antialias::edges;
  const Image smooth = drawn(*renderer);
  // Around the image of the green ball, which lies amid the glass.
  const auto middle = static_cast<glm::ivec2>(pixelOfImage({13, -4, 3}));
  int smoothed = 0;
  for (int y = middle.y - 6; y <= middle.y + 6; ++y)
    for (int x = middle.x - 6; x <= middle.x + 6; ++x) {
      const std::size_t at = 4 * static_cast<std::size_t>(y * kPx.x + x);
      smoothed += std::abs(plain.rgba[at + 1] - smooth.rgba[at + 1]) > 8 ? 1 : 0;
    }
  EXPECT_GT(smoothed, 8);
}

}  // namespace
}  // namespace render
