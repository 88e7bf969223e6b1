// Marks on soft tissue: where they are drawn, and the same on every back-end.
#include <gtest/gtest.h>

#include "render/gpu/offscreen_context.h"
#include "render/shaders/soft_constants.glsl"
#include "render/soft_block.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/twin_scene.h"

namespace render {
namespace {

using namespace render::testing;

constexpr glm::vec3 kGumCentre(6, -6, -4), kFaceCentre(-10, -8, 2);
constexpr float kGumRadius = 6.0f, kFaceRadius = 7.0f;

class SoftMarksDrawn : public ::testing::Test {
 protected:
  std::unique_ptr<FrameRenderer> open(Backend backend, float face_alpha = 1.0f) const {
    auto renderer = std::make_unique<FrameRenderer>(ct_.grid, ct_.solid, ct_.label, RenderOptions{.backend = backend});
    renderer->setFace({{ballMesh(kFaceCentre, kFaceRadius, {0.8f, 0.6f, 0.5f, face_alpha}, 96)}});
    renderer->setGingiva({{ballMesh(kGumCentre, kGumRadius, {0.7f, 0.3f, 0.3f, 1.0f}, 96)}});
    return renderer;
  }
  /// On a ball, where it faces the eye.
  static glm::dvec3 facing(const glm::vec3& centre, float radius) {
    return glm::dvec3(centre) + static_cast<double>(radius) * glm::normalize(kEye_P_mm - glm::dvec3(centre));
  }
  static Frame plain() { return frameFor(cameraRig({.eye_P_mm = kEye_P_mm, .look_at_P_mm = {-2, -6, 0}}, {200, 150})); }
  static Frame cutInGum() {
    Frame f = plain();
    const glm::dvec3 place = facing(kGumCentre, kGumRadius);
    f.marks.cuts = {{{place}, {place + glm::dvec3(0.8, 0.0, 0.0)}, 1.5}};
    return f;
  }

  static constexpr glm::dvec3 kEye_P_mm{10, -90, 30};
  OffscreenContext context_;
  assets::CtVolume ct_ = ballVolume(smallGrid(), {{{6, -6, -4}, 3.0}});
};

TEST_F(SoftMarksDrawn, AreTheSameOnEveryBackEnd) {
  const auto cpu = open(Backend::cpu);
  Frame marked = cutInGum();
  const glm::dvec3 on_face = facing(kFaceCentre, kFaceRadius);
  marked.marks.cuts.push_back({{on_face}, {on_face + glm::dvec3(0, 0, 2.0)}, 1.0});
  marked.marks.reddened = {{{facing(kGumCentre, kGumRadius) + glm::dvec3(0, 0, 4)}, 3.0, 1.0},
                           {{on_face - glm::dvec3(3, 0, 0)}, 4.0, 0.6}};
  for (const Backend backend : {Backend::gl_fragment, Backend::gl_compute}) {
    const auto gl = open(backend);
    for (const Eye eye : {Eye::left, Eye::right, Eye::cyclopean}) {
      const Difference d = between(*gl, *cpu, marked, eye);
      EXPECT_LE(d.worst, 2);
      EXPECT_LE(d.other_mm, 12) << "at the edge of the hole";
    }
    Frame faded = marked;
    faded.layers.face_opacity = 0.5f;
    EXPECT_LE(between(*gl, *cpu, faded, Eye::cyclopean).worst, 2);
  }
}

TEST_F(SoftMarksDrawn, ChangeNothingElsewhereAndNothingWhereThereAreNone) {
  for (const Backend backend : {Backend::cpu, Backend::gl_fragment}) {
    const auto renderer = open(backend);
    renderer->renderEye(plain(), Eye::cyclopean);
    const Image before = renderer->readEye(Eye::cyclopean);
    Frame far = plain();
    far.marks.cuts = {{{{0, 40, 0}}, {{5, 40, 0}}, 2.0}};
    renderer->renderEye(far, Eye::cyclopean);
    EXPECT_EQ(pixelsThatDiffer(before, renderer->readEye(Eye::cyclopean)), 0u);

    // Beyond the rim's cone nothing changes; the cut's own place does.
    const Frame cut = cutInGum();
    renderer->renderEye(cut, Eye::cyclopean);
    const Image after = renderer->readEye(Eye::cyclopean);
    const EyeView view = eyeView(cut.rig, Eye::cyclopean);
    const SoftBlock block = softBlock(cut.marks);
    int changed = 0;
    for (int y = 0; y < after.h; ++y)
      for (int x = 0; x < after.w; ++x) {
        const auto at = static_cast<std::size_t>(4 * (y * after.w + x));
        const bool differs = !std::equal(&after.rgba[at], &after.rgba[at] + 3, &before.rgba[at]);
        const auto mm = distanceToBall_mm(kEye_P_mm, rayDirection_P(cut.rig, view, x, y),
                                          {glm::dvec3(kGumCentre), static_cast<double>(kGumRadius)});
        const float away =
            mm ? cutDistance(block, glm::vec3(kEye_P_mm + *mm * rayDirection_P(cut.rig, view, x, y))) : 1e3f;
        if (away > SOFT_RIM_WIDTH + 0.05f) {
          EXPECT_FALSE(differs) << x << ' ' << y;
        } else if (away < SOFT_RIM_WIDTH - 0.25f) {
          EXPECT_TRUE(differs) << x << ' ' << y;
          ++changed;
        }
      }
    EXPECT_GT(changed, 60);
  }
}

TEST_F(SoftMarksDrawn, CutGingivaIsGone) {
  for (const Backend backend : {Backend::cpu, Backend::gl_fragment}) {
    const auto renderer = open(backend);
    const Frame cut = cutInGum();
    renderer->renderEye(cut, Eye::cyclopean);
    const DistanceImage seen = renderer->readDistance(Eye::cyclopean);
    const EyeView view = eyeView(cut.rig, Eye::cyclopean);
    const glm::ivec2 px(pixelOf(cut.rig, view, facing(kGumCentre, kGumRadius)));
    const double gum_mm = glm::distance(kEye_P_mm, facing(kGumCentre, kGumRadius));
    // The bone of 3 mm inside the ball of 6 mm.
    EXPECT_NEAR(seen.mm[static_cast<std::size_t>(px.y * seen.w + px.x)], gum_mm + 3.0, 0.1);
  }
}

TEST_F(SoftMarksDrawn, AreAsInANewPictureWhenTheyGrowAndWhenTheyEnd) {
  const auto renderer = open(Backend::cpu);
  Frame f = cutInGum();
  const auto expectFresh = [&](const char* what) {
    renderer->renderEye(f, Eye::left);
    const auto fresh = open(Backend::cpu);
    fresh->renderEye(f, Eye::left);
    EXPECT_EQ(pixelsThatDiffer(renderer->readEye(Eye::left), fresh->readEye(Eye::left)), 0u) << what;
  };
  expectFresh("first cut");
  f.marks.cuts[0].to_P.mm.z += 1.5;
  expectFresh("longer");
  f.marks.cuts.push_back({{facing(kGumCentre, kGumRadius) - glm::dvec3(0, 0, 3)}, {{0, 0, 0}}, 1.0});
  expectFresh("another");
  f.marks = {};
  expectFresh("none");
}

TEST_F(SoftMarksDrawn, PressedTissueIsRedderWhereItWasPressed) {
  const auto renderer = open(Backend::cpu);
  Frame f = plain();
  const glm::dvec3 place = facing(kFaceCentre, kFaceRadius);
  const glm::ivec2 px(pixelOf(f.rig, eyeView(f.rig, Eye::cyclopean), place));
  const auto rednessWith = [&](double share) {
    f.marks.reddened = {{{place}, 3.0, share}};
    renderer->renderEye(f, Eye::cyclopean);
    const Image image = renderer->readEye(Eye::cyclopean);
    const std::uint8_t* const at = &image.rgba[static_cast<std::size_t>(4 * (px.y * image.w + px.x))];
    return at[0] / static_cast<double>(at[1]);
  };
  const double none = rednessWith(0.0), half = rednessWith(0.5), full = rednessWith(1.0);
  EXPECT_GT(half, 1.1 * none);
  EXPECT_GT(full, 1.1 * half);
}

TEST(SoftBlock, MeasuresTheDistanceToSweptBallsAndIgnoresWhatIsTooMuch) {
  SoftMarks marks;
  marks.cuts = {{{{0, 0, 0}}, {{4, 0, 0}}, 1.0}};
  const SoftBlock block = softBlock(marks);
  EXPECT_NEAR(cutDistance(block, {2.0f, 1.5f, 0.0f}), 0.5f, 1e-6f);
  EXPECT_NEAR(cutDistance(block, {4.3f, 0.4f, 0.0f}), -0.5f, 1e-6f);
  EXPECT_GT(cutDistance(block, {40.0f, 0.0f, 0.0f}), 10.0f);
  marks.cuts.resize(kMostSoftCuts + 5, marks.cuts.front());
  marks.reddened.resize(kMostReddened + 5);
  EXPECT_EQ(softBlock(marks).counts, glm::ivec4(kMostSoftCuts, kMostReddened, 0, 0));
}

}  // namespace
}  // namespace render
