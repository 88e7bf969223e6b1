// The second instrument, in OpenGL and on the CPU.
#include <gtest/gtest.h>

#include "assets/instrument/dental_mirror.h"
#include "assets/instrument/handpiece.h"
#include "assets/instrument/retractor.h"
#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using namespace render::testing;

constexpr glm::ivec2 kPx{160, 120};

/// The mirror's glass at `position_P`, facing an eye at -y.
calibration::Pose<calibration::Patient, calibration::OtherTool> facing(const glm::dvec3& position_P) {
  return {glm::angleAxis(M_PI / 4.0, glm::dvec3(1, 0, 0)), position_P};
}

class SecondInstrument : public ::testing::TestWithParam<Backend> {
 protected:
  OffscreenContext context_;
  assets::CtVolume ct_ = ballVolume(smallGrid(), {{{0, 0, 0}, 6.0}});
  FrameRenderer renderer_{ct_.grid, ct_.solid, ct_.label, {.backend = GetParam()}};
  Frame frame_ = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, kPx));

  float distanceAt(const glm::dvec3& p_P) {
    renderer_.renderEye(frame_, Eye::cyclopean);
    const glm::dvec2 at = pixelOf(frame_.rig, eyeView(frame_.rig, Eye::cyclopean), p_P);
    return renderer_.readDistance(Eye::cyclopean)
        .mm[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(kPx.x) + static_cast<std::size_t>(at.x)];
  }
};

TEST_P(SecondInstrument, IsDrawnAtItsPoseAndCanBeHidden) {
  renderer_.setSecondInstrument(assets::dentalMirror());
  EXPECT_EQ(distanceAt({14, -20, 5}), 0.0f) << "not seen unless asked for";
  frame_.second_visible = true;
  for (const glm::dvec3 place : {glm::dvec3(14, -20, 5), glm::dvec3(-14, -30, -5)}) {
    frame_.X_PO = facing(place);
    const double from_eye_mm = glm::distance(eye_P_mm(frame_.rig, eyeView(frame_.rig, Eye::cyclopean)), place);
    EXPECT_NEAR(distanceAt(place), from_eye_mm, 0.3);
  }
  EXPECT_EQ(distanceAt({14, -20, 5}), 0.0f) << "it has moved away";
  frame_.second_visible = false;
  EXPECT_EQ(distanceAt({-14, -30, -5}), 0.0f);
  frame_.second_visible = true;
  renderer_.setSecondInstrument({});
  EXPECT_EQ(distanceAt({-14, -30, -5}), 0.0f);
}

TEST_P(SecondInstrument, MovesIndependentlyOfTheFirst) {
  renderer_.setInstrument(assets::surgicalHandpiece({}));
  renderer_.setSecondInstrument(assets::dentalMirror());
  frame_.tool_visible = frame_.second_visible = true;
  const glm::dvec3 bur(-14, -20, 2), mirror(12, -20, 0);
  frame_.X_PT.translation_mm = bur;
  frame_.X_PO = facing(mirror);
  const float bur_mm = distanceAt(bur), mirror_mm = distanceAt(mirror);
  EXPECT_GT(bur_mm, 0.0f);
  EXPECT_GT(mirror_mm, 0.0f);
  frame_.X_PT.translation_mm.z += 60.0;
  frame_.bur_angle_rad = 1.0;
  EXPECT_NE(distanceAt(bur), bur_mm);
  EXPECT_EQ(distanceAt(mirror), mirror_mm);
  frame_.X_PT.translation_mm = bur;
  frame_.bur_angle_rad = 0.0;
  frame_.X_PO = facing(mirror + glm::dvec3(0, 0, 60));
  EXPECT_EQ(distanceAt(bur), bur_mm);
  EXPECT_NE(distanceAt(mirror), mirror_mm);

  // The nearer one hides the other.
  frame_.X_PT.translation_mm = {0, -20, 0};
  frame_.X_PO = facing({0, -60, 0});
  EXPECT_NEAR(distanceAt({0, -20, 0}), 190.0, 0.5);
  frame_.X_PO = facing({0, -12, 0});
  EXPECT_NEAR(distanceAt({0, -20, 0}), 228.5, 1.0);
}

TEST_P(SecondInstrument, HidesTheCanalThatShowsThroughBone) {
  renderer_.setGuides({.mandibular_canal_P_mm = {{-8, 0, 0}, {8, 0, 0}}, .mandibular_canal_radius_mm = 1.5, .cut = {}});
  renderer_.setSecondInstrument(assets::dentalMirror());
  frame_.second_visible = true;
  const auto shining = [&] {
    std::array<Image, 2> images;
    for (const bool canal : {false, true}) {
      frame_.layers.mandibular_canal = canal;
      renderer_.renderEye(frame_, Eye::cyclopean);
      images[canal] = renderer_.readEye(Eye::cyclopean);
    }
    return pixelsThatDiffer(images[0], images[1], 8);
  };
  frame_.X_PO = facing({0, -40, 60});
  EXPECT_GT(shining(), 50u);
  frame_.X_PO = facing({0, -40, 0});
  EXPECT_EQ(shining(), 0u);
}

INSTANTIATE_TEST_SUITE_P(BackEnds, SecondInstrument, ::testing::Values(Backend::gl_fragment, Backend::cpu),
                         [](const auto& chosen) { return chosen.param == Backend::cpu ? "Cpu" : "OpenGl"; });

TEST(SecondInstrumentTwin, IsTheSameOnTheCpuAsInOpenGl) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{-4, 0, 0}, 8.0}, {{8, 3, 2}, 4.0}});
  FrameRenderer gl(ct.grid, ct.solid, ct.label), cpu(ct.grid, ct.solid, ct.label, {.backend = Backend::cpu});
  for (const assets::MeshModel& model : {assets::dentalMirror(), assets::retractor()})
    for (const bool mirrored : {false, true}) {
      Frame frame = frameFor(cameraRig({.eye_P_mm = {20, -110, 45}}, kPx));
      if (mirrored) frame.rig = throughMirror(frame.rig);
      frame.tool_visible = frame.second_visible = true;
      frame.X_PT = {glm::angleAxis(1.0, glm::dvec3(1, 0, 0)), {4, -10, 6}};
      frame.X_PO = {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 0.4, 0.2))), {-3, -9, 2}};
      std::array<Image, 2> images;
      std::array<DistanceImage, 2> distances;
      std::size_t n = 0;
      for (FrameRenderer* renderer : {&gl, &cpu}) {
        renderer->setInstrument(assets::surgicalHandpiece({}));
        renderer->setSecondInstrument(model);
        renderer->renderEye(frame, Eye::cyclopean);
        images[n] = renderer->readEye(Eye::cyclopean);
        distances[n++] = renderer->readDistance(Eye::cyclopean);
      }
      // Except for pixels on a silhouette, hit by one and missed by the other.
      std::size_t beyond = 0, elsewhere = 0;
      for (std::size_t i = 0; i < distances[0].mm.size(); ++i) {
        const bool is_other = std::abs(distances[0].mm[i] - distances[1].mm[i]) > 0.1f;
        int worst = 0;
        for (std::size_t c = 4 * i; c < 4 * i + 3; ++c)
          worst = std::max(worst, std::abs(images[0].rgba[c] - images[1].rgba[c]));
        elsewhere += is_other ? 1 : 0;
        beyond += !is_other && worst > 2 ? 1 : 0;
      }
      EXPECT_LE(beyond, 2u) << model.parts.front().name << mirrored;
      EXPECT_LE(elsewhere, 60u) << model.parts.front().name << mirrored;
    }
}

// Static hits of an unmoved eye are cached; instruments must not be.
TEST(SecondInstrumentTwin, IsDrawnAtItsNewPoseForAnUnmovedEye) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 6.0}});
  const auto dressed = [&] {
    auto renderer =
        std::make_unique<FrameRenderer>(ct.grid, ct.solid, ct.label, RenderOptions{.backend = Backend::cpu});
    renderer->setGingiva(assets::retractor());
    renderer->setInstrument(assets::surgicalHandpiece({}));
    renderer->setSecondInstrument(assets::dentalMirror());
    return renderer;
  };
  const auto kept = dressed();
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -250, 0}, .fov_y_rad = 0.17}, kPx));
  frame.tool_visible = frame.second_visible = true;
  frame.X_PT.translation_mm = {-10, -20, 0};
  const auto expectFresh = [&](const char* what) {
    kept->renderEye(frame, Eye::cyclopean);
    const auto fresh = dressed();
    fresh->renderEye(frame, Eye::cyclopean);
    EXPECT_EQ(pixelsThatDiffer(kept->readEye(Eye::cyclopean), fresh->readEye(Eye::cyclopean)), 0u) << what;
  };
  expectFresh("first");
  frame.X_PO = facing({10, -20, 0});
  expectFresh("moved");
  frame.X_PO = facing({-10, -30, 0});
  expectFresh("before the first");
  frame.second_visible = false;
  expectFresh("away");
  frame.second_visible = true;
  expectFresh("back");
}

}  // namespace
}  // namespace render
