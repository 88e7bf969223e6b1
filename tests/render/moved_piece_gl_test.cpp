// A piece of tooth that has left the jaw, on every back-end, against the same tooth as voxels at its new place.
#include <gtest/gtest.h>

#include "assets/instrument/dental_mirror.h"
#include "assets/tissue.h"
#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/twin_scene.h"

namespace render {
namespace {

using namespace render::testing;
using PiecePose = calibration::Pose<calibration::Patient, calibration::Piece>;

constexpr glm::ivec2 kPx{160, 120};
constexpr double kSpacing_mm = 0.25;

/// A tooth of two balls, crown and root, with grey rims two voxels wide; its labels.
double solidOfTooth(const glm::dvec3& p_Q) {
  const double crown_mm = 3.0 - glm::length(p_Q - glm::dvec3(0, 0, 1)),
               root_mm = 2.0 - glm::length(p_Q - glm::dvec3(0.5, 0, -2));
  return std::clamp(0.5 + 0.25 * std::max(crown_mm, root_mm) / kSpacing_mm, 0.0, 1.0);
}
std::uint8_t labelOfTooth(const glm::dvec3& p_Q) {
  return static_cast<std::uint8_t>(p_Q.z > -0.5 ? assets::Tissue::enamel : assets::Tissue::dentine);
}

/// The tooth sampled where X_PQ has brought it.
assets::CtVolume toothVolume(const PiecePose& X_PQ, glm::ivec3 size = glm::ivec3(80)) {
  const assets::VolumeGrid grid = smallGrid(size, kSpacing_mm);
  assets::CtVolume ct{grid, {}, std::vector<std::uint8_t>(grid.voxelCount(), 1), {}, {}};
  ct.solid.resize(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p_Q = (X_PQ.inverse() * calibration::Point<calibration::Patient>{grid.centre_P_mm(ijk)}).mm;
    ct.solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * solidOfTooth(p_Q)));
    ct.label[v] = labelOfTooth(p_Q);
  });
  return ct;
}

PiecePose someWay() { return {glm::angleAxis(0.35, glm::normalize(glm::dvec3(1, 2, 3))), {1.3, 0.4, 2.1}}; }

Frame frameOf(const std::optional<PiecePose>& X_PQ) {
  Frame frame = frameFor(cameraRig({.eye_P_mm = {60, -240, 40}, .fov_y_rad = 0.06}, kPx));
  frame.pieces[0] = X_PQ;
  return frame;
}

class MovedPiece : public ::testing::TestWithParam<Backend> {
 protected:
  /// The jaw without solid where the tooth was, but with its labels.
  std::unique_ptr<FrameRenderer> jawWithPiece(std::vector<std::uint8_t> jaw_solid = {}) const {
    if (jaw_solid.empty()) jaw_solid.resize(tooth_.solid.size(), 0);
    auto renderer = rendererOf(jaw_solid, tooth_.label);
    renderer->setPiece(0, tooth_.grid, tooth_.solid);
    return renderer;
  }
  std::unique_ptr<FrameRenderer> rendererOf(std::span<const std::uint8_t> solid,
                                            std::span<const std::uint8_t> label) const {
    return std::make_unique<FrameRenderer>(tooth_.grid, solid, label, RenderOptions{.backend = GetParam()});
  }

  OffscreenContext context_;
  assets::CtVolume tooth_ = toothVolume({});
};

struct Seen {
  Image image;
  DistanceImage distance;
};
Seen seen(FrameRenderer& renderer, const Frame& frame, Eye eye = Eye::cyclopean) {
  renderer.renderEye(frame, eye);
  return {renderer.readEye(eye), renderer.readDistance(eye)};
}

// Pixels of 0.12 mm. Silhouettes differ by less than one of them; depth by what flat triangles and the other sampling
// of a rim allow; light by the mottle, which stays with the matter, and by coarse shade, 3 of 255 in the mean.
TEST_P(MovedPiece, LooksAsItsVoxelsAtItsNewPlace) {
  const assets::CtVolume resampled = toothVolume(someWay());
  const auto moved = jawWithPiece(), voxels = rendererOf(resampled.solid, resampled.label);
  for (const Eye eye : {Eye::left, Eye::right}) {
    const Seen piece = seen(*moved, frameOf(someWay()), eye), expected = seen(*voxels, frameOf({}), eye);
    int both = 0, one = 0, apart = 0;
    double worst_mm = 0.0, light = 0.0;
    for (std::size_t i = 0; i < expected.distance.mm.size(); ++i) {
      const float a = piece.distance.mm[i], b = expected.distance.mm[i];
      one += (a > 0.0f) != (b > 0.0f);
      if (a == 0.0f || b == 0.0f) continue;
      ++both;
      const double apart_mm = std::abs(double{a} - double{b});
      // A slope seen along it hides the ray's place: less than one pixel in a hundred.
      apart += apart_mm > 0.05;
      worst_mm = std::max(worst_mm, apart_mm > 0.5 ? 0.0 : apart_mm);
      for (std::size_t c = 4 * i; c < 4 * i + 3; ++c)
        light += std::abs(piece.image.rgba[c] - expected.image.rgba[c]) / 3.0;
    }
    std::printf("%d pixels, %d at the silhouette, %d deeper than 0.05 mm, worst %.3f mm, light %.2f\n", both, one,
                apart, worst_mm, light / both);
    EXPECT_GT(both, 1500);
    EXPECT_LE(one, both / 100);
    EXPECT_LE(apart, both / 100);
    EXPECT_LT(light / both, 3.0);
  }
}

TEST_P(MovedPiece, ChangesNothingUntilItHasAPose) {
  const auto with = jawWithPiece(tooth_.solid), without = rendererOf(tooth_.solid, tooth_.label);
  EXPECT_EQ(seen(*with, frameOf({})).image.rgba, seen(*without, frameOf({})).image.rgba);
  // And after it was shown and has come back.
  EXPECT_GT(pixelsThatDiffer(seen(*with, frameOf(someWay())).image, seen(*without, frameOf({})).image), 100u);
  EXPECT_EQ(seen(*with, frameOf({})).image.rgba, seen(*without, frameOf({})).image.rgba);
}

TEST_P(MovedPiece, HidesAndIsHiddenByDepth) {
  const auto jaw = ballVolume(tooth_.grid, {{{0, -6, 0}, 2.0}});
  const auto renderer = jawWithPiece(jaw.solid);
  const auto distanceOf = [&](const PiecePose& X_PQ) {
    const Frame frame = frameOf(X_PQ);
    const glm::dvec2 at = pixelOf(frame.rig, eyeView(frame.rig, Eye::cyclopean), {0, -6, 0});
    return seen(*renderer, frame)
        .distance.mm[static_cast<std::size_t>(at.y) * std::size_t{kPx.x} + static_cast<std::size_t>(at.x)];
  };
  const glm::dvec3 to_eye = glm::normalize(glm::dvec3(60, -234, 40));
  const float alone_mm = distanceOf({{1, 0, 0, 0}, {0, 0, 60}});
  EXPECT_GT(alone_mm, 0.0f);
  EXPECT_EQ(distanceOf({{1, 0, 0, 0}, glm::dvec3(0, -6, 0) - 8.0 * to_eye}), alone_mm) << "behind bone";
  EXPECT_NEAR(distanceOf({{1, 0, 0, 0}, glm::dvec3(0, -6, 0) + 8.0 * to_eye}), alone_mm - 8.9, 0.8) << "before bone";

  renderer->setSecondInstrument(assets::dentalMirror());
  Frame frame = frameOf(PiecePose{{1, 0, 0, 0}, glm::dvec3(0, -6, 0) + 8.0 * to_eye});
  frame.second_visible = true;
  frame.X_PO = {glm::angleAxis(M_PI / 4.0, glm::dvec3(1, 0, 0)), glm::dvec3(0, -6, 0) + 30.0 * to_eye};
  const Seen behind = seen(*renderer, frame);
  frame.pieces[0].reset();
  EXPECT_EQ(pixelsThatDiffer(behind.image, seen(*renderer, frame).image, 40), 0u) << "behind the mirror";
}

TEST_P(MovedPiece, IsCutWhereItLies) {
  // Two bricks lose half of their voxels.
  assets::CtVolume cut = tooth_;
  const auto renderer = jawWithPiece();
  const Seen whole = seen(*renderer, frameOf(someWay()));
  for (const glm::ivec3 brick : {glm::ivec3(5, 4, 6), glm::ivec3(5, 4, 5)}) {
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 8; ++i) cut.solid[cut.grid.index(8 * brick + glm::ivec3(i, j, k))] = 0;
    const std::vector<std::uint8_t> values = brickOf(cut, brick);
    renderer->updatePieceBrick(0, brick, std::span<const std::uint8_t, 512>(values.data(), 512));
  }
  const auto fresh = rendererOf(std::vector<std::uint8_t>(tooth_.solid.size(), 0), tooth_.label);
  fresh->setPiece(0, cut.grid, cut.solid);
  const Seen updated = seen(*renderer, frameOf(someWay()));
  EXPECT_EQ(updated.image.rgba, seen(*fresh, frameOf(someWay())).image.rgba);
  EXPECT_GT(pixelsThatDiffer(updated.image, whole.image, 8), 100u) << "the control: the cut is in sight";
}

TEST_P(MovedPiece, ShadesBoneUntilItIsGone) {
  const auto jaw = ballVolume(tooth_.grid, {{{0, 0, -8}, 6.0}});
  const auto renderer = jawWithPiece(jaw.solid);
  const Seen open = seen(*renderer, frameOf({})), shaded = seen(*renderer, frameOf(PiecePose{{1, 0, 0, 0}, {0, 0, 2}}));
  int darker = 0, brighter = 0;
  for (std::size_t i = 0; i < open.distance.mm.size(); ++i) {
    if (open.distance.mm[i] == 0.0f || open.distance.mm[i] != shaded.distance.mm[i]) continue;
    darker += shaded.image.rgba[4 * i] < open.image.rgba[4 * i] - 20;
    brighter += shaded.image.rgba[4 * i] > open.image.rgba[4 * i];
  }
  EXPECT_GT(darker, 50);
  EXPECT_EQ(brighter, 0);
  EXPECT_EQ(seen(*renderer, frameOf({})).image.rgba, open.image.rgba);
}

INSTANTIATE_TEST_SUITE_P(Backends, MovedPiece,
                         ::testing::Values(Backend::gl_fragment, Backend::gl_compute, Backend::cpu));

TEST(MovedPieceTwin, IsTheSameOnProcessorAndCard) {
  const OffscreenContext context;
  const assets::CtVolume tooth = toothVolume({});
  const auto jaw = ballVolume(tooth.grid, {{{0, 1, -6}, 5.0}});
  for (const bool mirrored : {false, true}) {
    Frame frame = frameOf(someWay());
    if (mirrored) frame.rig = throughMirror(frame.rig);
    frame.field = {{{0, 0, 0}}, 6.0, 0.6, 0.5, 0.3, 0.4};
    for (const ViewMode mode : {ViewMode::iso, ViewMode::dvr}) {
      frame.mode = mode;
      FrameRenderer gl(tooth.grid, jaw.solid, tooth.label), cpu(tooth.grid, jaw.solid, tooth.label, {Backend::cpu});
      for (FrameRenderer* renderer : {&gl, &cpu}) renderer->setPiece(0, tooth.grid, tooth.solid);
      const Difference d = between(gl, cpu, frame, Eye::left);
      EXPECT_LE(d.beyond, 4) << mirrored << static_cast<int>(mode);
      EXPECT_LE(d.other_mm, 60) << mirrored << static_cast<int>(mode);
      EXPECT_LT(d.worst_mm, 0.1);
    }
  }
}

// The gap to a piece is that to its voxels at the same place.
TEST(MovedPieceGap, IsFoundOnThePiece) {
  const assets::CtVolume tooth = toothVolume({}), resampled = toothVolume(someWay());
  const std::vector<std::uint8_t> empty(tooth.solid.size(), 0);
  FrameRenderer moved(tooth.grid, empty, {}, {Backend::cpu}), voxels(tooth.grid, resampled.solid, {}, {Backend::cpu});
  moved.setPiece(0, tooth.grid, tooth.solid);
  Frame frame = frameOf(someWay());
  frame.bur_radius_mm = 1.0;
  for (const glm::dvec3 place : {glm::dvec3(7, 0, 3), glm::dvec3(0, -6, 2), glm::dvec3(1, 1, 8.5)}) {
    frame.X_PT.translation_mm = place;
    const auto found = moved.gap(frame), expected = voxels.gap(frame);
    ASSERT_TRUE(found && expected);
    EXPECT_NEAR(found->mm, expected->mm, 0.05);
    EXPECT_LT(glm::distance(found->nearest_P.mm, expected->nearest_P.mm), 0.5);
  }
  frame.pieces[0].reset();
  EXPECT_FALSE(moved.gap(frame));
}

}  // namespace
}  // namespace render
