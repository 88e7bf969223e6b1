// The light of a curing lamp: blue where it reaches, nowhere else, and the same on every back-end.
#include <gtest/gtest.h>

#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/twin_scene.h"

namespace render {
namespace {

using namespace render::testing;

class CuringLight : public ::testing::Test {
 protected:
  std::unique_ptr<FrameRenderer> open(Backend backend) const {
    auto renderer = std::make_unique<FrameRenderer>(ct_.grid, ct_.solid, ct_.label, RenderOptions{.backend = backend});
    renderer->setGingiva({{ballMesh({-8, -6, -4}, 4.0f, {0.7f, 0.3f, 0.3f, 1.0f}, 96)}});
    return renderer;
  }
  static Frame plain() {
    Frame f = frameFor(cameraRig({.eye_P_mm = {10, -90, 30}, .look_at_P_mm = {-2, -6, 0}}, {200, 150}));
    f.tool_visible = false;
    f.layers.gap_ring = false;
    return f;
  }
  /// Towards the ball of bone, from the side of the eye.
  static Frame shone(double from_mm = 5.0) {
    Frame f = plain();
    const glm::dvec3 way = glm::normalize(glm::dvec3(6, -6, -4) - glm::dvec3(10, -90, 30));
    f.curing = CuringSpot{{glm::dvec3(6, -6, -4) - (3.0 + from_mm) * way}, way, 2.0, 8.0};
    return f;
  }
  struct Colours {
    double red = 0.0, blue = 0.0;
    int changed = 0;
  };
  static Colours changeOf(const Image& dark, const Image& lit) {
    Colours sum;
    for (std::size_t n = 0; n < dark.rgba.size(); n += 4) {
      const int red = lit.rgba[n] - dark.rgba[n], blue = lit.rgba[n + 2] - dark.rgba[n + 2];
      sum.red += red, sum.blue += blue;
      sum.changed += red != 0 || blue != 0 ? 1 : 0;
    }
    return sum;
  }

  OffscreenContext context_;
  assets::CtVolume ct_ = ballVolume(smallGrid(), {{{6, -6, -4}, 3.0}});
};

TEST_F(CuringLight, IsTheSameOnEveryBackEnd) {
  const auto cpu = open(Backend::cpu);
  for (const Backend backend : {Backend::gl_fragment, Backend::gl_compute}) {
    const auto gl = open(backend);
    for (const double from_mm : {1.0, 5.0}) EXPECT_LE(between(*gl, *cpu, shone(from_mm), Eye::cyclopean).worst, 2);
  }
}

TEST_F(CuringLight, IsBlueAndFallsOnWhatItReachesAlone) {
  const auto cpu = open(Backend::cpu);
  const auto drawn = [&](const Frame& frame) {
    cpu->renderEye(frame, Eye::cyclopean);
    return cpu->readEye(Eye::cyclopean);
  };
  const Image dark = drawn(plain());
  const Colours near = changeOf(dark, drawn(shone(1.0))), far = changeOf(dark, drawn(shone(5.0)));
  EXPECT_GT(near.changed, 50);
  EXPECT_GT(near.blue, 2.0 * near.red);
  EXPECT_GT(near.blue, 1.2 * far.blue) << "it falls off";
  EXPECT_GT(far.blue, 0.0);
  EXPECT_EQ(changeOf(dark, drawn(shone(8.5))).changed, 0) << "farther than it reaches";
  Frame away = shone(1.0);
  away.curing->axis_P = -away.curing->axis_P;
  EXPECT_EQ(changeOf(dark, drawn(away)).changed, 0) << "behind it";
}

}  // namespace
}  // namespace render
