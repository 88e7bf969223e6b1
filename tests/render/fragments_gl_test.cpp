// What a broken file has left in a tooth, on every back-end: seen through a clear tooth, hidden in one that is not.
#include <gtest/gtest.h>

#include "assets/instrument/canal_file.h"
#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/twin_scene.h"

namespace render {
namespace {

using namespace render::testing;

constexpr glm::ivec2 kFilm_px{160, 120};

/// Within a ball of bone, across the view.
assets::MetalFragment wireInBall() {
  return {60, false, {{-3.0, 0.0, 0.0}, {0.0, 0.0, 0.5}, {3.0, 0.0, 0.0}}, {0.4, 0.4, 0.4}};
}

TEST(FragmentWires, AreAsLongAndThickAsTheFragment) {
  const assets::MetalFragment one = wireInBall();
  const assets::MeshModel mesh = assets::fragmentWires(std::span(&one, 1));
  ASSERT_EQ(mesh.parts.size(), 1u);
  glm::vec3 low(1e9f), high(-1e9f);
  for (const glm::vec3& p : mesh.parts[0].position_mm) low = glm::min(low, p), high = glm::max(high, p);
  EXPECT_NEAR(low.x, -3.0, 0.2);
  EXPECT_NEAR(high.x, 3.0, 0.2);
  EXPECT_GT(high.y - low.y, 0.5f);
  EXPECT_LT(high.y - low.y, 0.9f);
  EXPECT_TRUE(assets::fragmentWires({}).parts.empty());
}

class FragmentsDrawn : public ::testing::TestWithParam<Backend> {
 protected:
  OffscreenContext context_;
  assets::VolumeGrid grid_ = smallGrid(glm::ivec3(80), 0.25);

  Image picture(FrameRenderer& renderer, ViewMode mode) const {
    Frame frame = frameFor(cameraRig({.eye_P_mm = {60, -240, 40}, .fov_y_rad = 0.06}, kFilm_px));
    frame.mode = mode;
    renderer.renderEye(frame, Eye::cyclopean);
    return renderer.readEye(Eye::cyclopean);
  }
};

int pixelsThatDiffer(const Image& a, const Image& b) {
  int differ = 0;
  for (std::size_t p = 0; p < a.rgba.size(); p += 4) differ += std::abs(a.rgba[p] - b.rgba[p]) > 6;
  return differ;
}

TEST_P(FragmentsDrawn, AreSeenThroughAClearToothAlone) {
  const auto jaw = ballVolume(grid_, {{{0, 0, 0}, 6.0}});
  const std::vector<std::uint8_t> dentine(grid_.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::dentine));
  FrameRenderer renderer(grid_, jaw.solid, dentine, {GetParam()});
  const Image clear = picture(renderer, ViewMode::clear), opaque = picture(renderer, ViewMode::iso);
  const assets::MetalFragment one = wireInBall();
  renderer.setFragments(assets::fragmentWires(std::span(&one, 1)));
  EXPECT_GT(pixelsThatDiffer(clear, picture(renderer, ViewMode::clear)), 40);
  EXPECT_LT(pixelsThatDiffer(opaque, picture(renderer, ViewMode::iso)), 5);
  renderer.setFragments({});
  EXPECT_EQ(pixelsThatDiffer(clear, picture(renderer, ViewMode::clear)), 0);
}

INSTANTIATE_TEST_SUITE_P(Backends, FragmentsDrawn,
                         ::testing::Values(Backend::gl_fragment, Backend::gl_compute, Backend::cpu));

}  // namespace
}  // namespace render
