// The drawn volume: position of the surface, identity with and without skipping, carving.
#include <gtest/gtest.h>

#include "render/gpu/gpu_error.h"
#include "render/gpu/offscreen_context.h"
#include "render/volume/transfer_function.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using calibration::Rig;
using testing::Ball;
using testing::ballVolume;
using testing::brickOf;
using testing::frameFor;
using testing::Random;
using testing::smallGrid;

const glm::ivec2 kPx{160, 120};

Rig closeUp(const glm::dvec3& from = {60, -200, 80}) {
  return cameraRig({.eye_P_mm = from, .look_at_P_mm = {0, 0, 0}, .fov_y_rad = 0.17}, kPx);
}

// One pass of a round bur over the outside of the ball; not inlined, so that all callers round alike.
[[gnu::noinline]] void carveGroove(assets::CtVolume& ct) {
  for (int step = 0; step < 12; ++step) {
    const glm::dvec3 bur{-3.0 + 0.5 * step, -9.0, 1.0};
    for (std::size_t v = 0; v < ct.solid.size(); ++v) {
      const int n = static_cast<int>(v), w = ct.grid.size.x, h = ct.grid.size.y;
      const double outside = glm::length(ct.grid.centre_P_mm({n % w, n / w % h, n / (w * h)}) - bur) - 2.0;
      const double keep = std::clamp(0.5 + outside / ct.grid.spacing_mm, 0.0, 1.0);
      ct.solid[v] = std::min(ct.solid[v], static_cast<std::uint8_t>(std::lround(255.0 * keep)));
    }
  }
}

struct Drawn {
  Image image;
  DistanceImage distance;
};

Drawn drawn(FrameRenderer& renderer, const Rig& rig, ViewMode mode = ViewMode::iso) {
  Frame frame = frameFor(rig);
  frame.mode = mode;
  renderer.renderEye(frame, Eye::left);
  return {renderer.readEye(Eye::left), renderer.readDistance(Eye::left)};
}

TEST(RayCaster, DrawsTheSurfaceWhereSolidIsAHalf) {
  const OffscreenContext context;
  const Ball ball{{0.3, -0.2, 0.1}, 9.0};
  const assets::CtVolume ct = ballVolume(smallGrid(), {ball});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  Random random(21);
  double worst_mm = 0.0;
  for (int n = 0; n < 5; ++n) {
    const Rig rig = closeUp(200.0 * random.direction());
    const Drawn seen = drawn(renderer, rig);
    const EyeView view = eyeView(rig, Eye::left);
    int hits = 0;
    for (int y = 0; y < kPx.y; ++y)
      for (int x = 0; x < kPx.x; ++x) {
        const double distance_mm = seen.distance.mm[static_cast<std::size_t>(y * kPx.x + x)];
        if (distance_mm == 0.0) continue;
        ++hits;
        const glm::dvec3 p = testing::eye_P_mm(rig, view) + distance_mm * testing::rayDirection_P(rig, view, x, y);
        worst_mm = std::max(worst_mm, std::abs(glm::length(p - ball.centre_P_mm) - ball.radius_mm));
      }
    EXPECT_GT(hits, 3000);
  }
  EXPECT_LT(worst_mm, 0.05);
  EXPECT_NO_THROW(renderer.throwIfError());
}

TEST(RayCaster, SkippingEmptySpaceChangesNoBit) {
  const OffscreenContext context;
  assets::CtVolume ct = ballVolume(smallGrid({75, 64, 90}), {{{-8, 0, 5}, 6.0}, {{9, 4, -9}, 4.0}, {{3, -9, 14}, 2.0}});
  for (const bool carved : {false, true}) {
    if (carved) carveGroove(ct);
    FrameRenderer skipping(ct.grid, ct.solid, ct.label),
        marching(ct.grid, ct.solid, ct.label, {.skip_empty_space = false});
    for (const glm::dvec3& from : {glm::dvec3(60, -200, 80), glm::dvec3(0, -200, 0.001), glm::dvec3(-20, 30, 210)})
      for (const ViewMode mode : {ViewMode::iso, ViewMode::dvr}) {
        const Drawn fast = drawn(skipping, closeUp(from), mode), slow = drawn(marching, closeUp(from), mode);
        EXPECT_EQ(fast.image.rgba, slow.image.rgba);
        EXPECT_EQ(fast.distance.mm, slow.distance.mm);
        EXPECT_GT(std::ranges::count_if(slow.distance.mm, [](float mm) { return mm > 0.0f; }), 500);
      }
  }
}

// Both are built from one body. Drivers may contract or reorder arithmetic differently in the two stages, so one
// rounding step is allowed.
TEST(RayCaster, FragmentAndComputeDrawTheSameImage) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(), {{{-6, 0, 5}, 6.0}, {{7, 4, -6}, 4.0}});
  FrameRenderer fragment(ct.grid, ct.solid, ct.label),
      compute(ct.grid, ct.solid, ct.label, {.backend = Backend::gl_compute});
  for (const ViewMode mode : {ViewMode::iso, ViewMode::dvr}) {
    const Drawn one = drawn(fragment, closeUp(), mode), other = drawn(compute, closeUp(), mode);
    EXPECT_EQ(testing::pixelsThatDiffer(one.image, other.image, 1), 0u);
    double worst_mm = 0.0;
    for (std::size_t n = 0; n < one.distance.mm.size(); ++n)
      worst_mm = std::max(worst_mm, std::abs(double{one.distance.mm[n]} - double{other.distance.mm[n]}));
    EXPECT_LT(worst_mm, 0.01);
    EXPECT_GT(std::ranges::count_if(one.distance.mm, [](float mm) { return mm > 0.0f; }), 500);
  }
  EXPECT_NO_THROW(compute.throwIfError());
}

// Inverse of IEC 61966-2-1.
double lightOf(std::uint8_t srgb) {
  const double v = srgb / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

assets::MeshModel plate(double y_mm, float grey) {
  assets::MeshPart part;
  part.position_mm = {{-30, y_mm, -30}, {30, y_mm, -30}, {30, y_mm, 30}, {-30, y_mm, 30}};
  part.normal.assign(4, {0.0f, -1.0f, 0.0f});
  part.triangles = {0, 1, 2, 0, 2, 3};
  part.material = {.base_colour = {grey, grey, grey, 1.0f}, .roughness = 1.0f};
  return {{part}};
}

// A slab has a closed form: it transmits (1 - a)^thickness, whatever the step.
TEST(RayCaster, TranslucentMatterAttenuatesByThickness) {
  const OffscreenContext context;
  const assets::VolumeGrid grid = smallGrid(glm::ivec3(40), 0.5);
  std::vector<std::uint8_t> solid(grid.voxelCount(), 0);
  for (std::size_t n = 0; n < solid.size(); ++n)
    if (const int j = static_cast<int>(n) / 40 % 40; j >= 18 && j < 22) solid[n] = 255;
  const std::vector<std::uint8_t> nothing(grid.voxelCount(), 0), cortical(grid.voxelCount(), 1);
  Frame frame = frameFor(cameraRig({.eye_P_mm = {0, -400, 0}, .look_at_P_mm = {0, 0, 0}, .fov_y_rad = 0.05}, {32, 24}));
  frame.mode = ViewMode::dvr;
  frame.quality.ambient_occlusion = frame.quality.lamp_shadow = false;

  // Difference in the image between a grey and a black plate behind the slab.
  const auto plateLight = [&](std::span<const std::uint8_t> matter, double step) {
    FrameRenderer renderer(grid, matter, cortical);
    frame.quality.step_voxels = step;
    double light[2];
    for (const int grey : {0, 1}) {
      renderer.setGingiva(plate(15.0, grey == 0 ? 0.0f : 0.5f));
      renderer.renderEye(frame, Eye::cyclopean);
      light[grey] = lightOf(renderer.readEye(Eye::cyclopean).rgba[4 * (12 * 32 + 16)]);
    }
    return light[1] - light[0];
  };

  // The optical thickness: 1.5 mm of full bone and half a millimetre of ramp on each side.
  const double a = double{kFrosted.inner_per_mm[1]};
  double log_through = 1.5 * std::log(1.0 - a);
  for (double x = 0.0005; x < 1.0; x += 0.001) {
    const double share = std::clamp((x - kRampStart) / (kRampFull - kRampStart), 0.0, 1.0);
    log_through += 2.0 * 0.5 * 0.001 * std::log(1.0 - a * share);
  }
  const double bare = plateLight(nothing, 0.5);
  EXPECT_GT(bare, 0.1);
  for (const double step : {0.5, 0.25, 0.125})
    EXPECT_NEAR(plateLight(solid, step) / bare, std::exp(log_through), 0.03) << "step " << step;
}

TEST(RayCaster, CarvedBricksEqualAFullUpload) {
  const OffscreenContext context;
  const assets::CtVolume before = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
  assets::CtVolume after = before;
  carveGroove(after);
  FrameRenderer carved(before.grid, before.solid, before.label), fresh(after.grid, after.solid, after.label);
  const Rig rig = closeUp({10, -200, 20});
  const Drawn control = drawn(carved, rig);

  // Only changed bricks are sent, in the frame that must show them.
  for (int n = 0; n < 512; ++n) {
    const glm::ivec3 brick{n % 8, n / 8 % 8, n / 64};
    const std::vector<std::uint8_t> values = brickOf(after, brick);
    if (values != brickOf(before, brick)) carved.updateBrick(brick, std::span<const std::uint8_t, 512>(values));
  }
  const Drawn updated = drawn(carved, rig), expected = drawn(fresh, rig);
  EXPECT_EQ(updated.image.rgba, expected.image.rgba);
  EXPECT_EQ(updated.distance.mm, expected.distance.mm);
  EXPECT_GT(testing::pixelsThatDiffer(updated.image, control.image, 8), 300u);

  // The next frame, without changes, updates the stale distances and gives the same image.
  EXPECT_EQ(drawn(carved, rig).image.rgba, expected.image.rgba);
}

TEST(RayCaster, FilledBricksAppearAtOnce) {
  const OffscreenContext context;
  const assets::CtVolume empty = ballVolume(smallGrid(), {}), full = ballVolume(smallGrid(), {{{0, 0, 0}, 9.0}});
  FrameRenderer refilled(empty.grid, empty.solid, empty.label), fresh(full.grid, full.solid, full.label);
  drawn(refilled, closeUp());
  for (int n = 0; n < 512; ++n) {
    const glm::ivec3 brick{n % 8, n / 8 % 8, n / 64};
    const std::vector<std::uint8_t> values = brickOf(full, brick);
    refilled.updateBrick(brick, std::span<const std::uint8_t, 512>(values));
  }
  EXPECT_EQ(drawn(refilled, closeUp()).image.rgba, drawn(fresh, closeUp()).image.rgba);
}

TEST(RayCaster, ClosesTheBoneWhereTheScanEnds) {
  const OffscreenContext context;
  const assets::VolumeGrid grid = smallGrid(glm::ivec3(20), 1.0);
  const std::vector<std::uint8_t> solid(grid.voxelCount(), 255);
  FrameRenderer renderer(grid, solid, {});
  const Rig rig = cameraRig({.eye_P_mm = {0, -200, 0}, .look_at_P_mm = {0, 0, 0}, .fov_y_rad = 0.17}, kPx);
  renderer.renderEye(frameFor(rig), Eye::cyclopean);
  const DistanceImage seen = renderer.readDistance(Eye::cyclopean);
  EXPECT_NEAR(seen.mm[static_cast<std::size_t>(60 * 160 + 80)], 200.0 - 10.0, 0.02);
}

TEST(RayCaster, DrawsTheSameFromInsideTheEmptyPartOfTheVolume) {
  const OffscreenContext context;
  const Ball ball{{0, 10, 0}, 3.0};
  const assets::CtVolume ct = ballVolume(smallGrid(), {ball});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  const Rig rig = cameraRig({.eye_P_mm = {0, -8, 0}, .look_at_P_mm = {0, 10, 0}, .ipd_mm = 0.0}, kPx);
  renderer.renderEye(frameFor(rig), Eye::cyclopean);
  EXPECT_NEAR(renderer.readDistance(Eye::cyclopean).mm[static_cast<std::size_t>(60 * 160 + 80)], 15.0, 0.05);
}

TEST(RayCaster, RefusesAVolumeWhoseValuesDoNotFillIt) {
  const OffscreenContext context;
  const assets::CtVolume ct = ballVolume(smallGrid(glm::ivec3(16)), {});
  EXPECT_THROW(FrameRenderer(ct.grid, std::span(ct.solid).first(9), ct.label), GpuError);
  EXPECT_THROW(FrameRenderer(ct.grid, ct.solid, std::span(ct.label).first(9)), GpuError);
  EXPECT_THROW(FrameRenderer(assets::VolumeGrid{}, {}, {}), GpuError);
}

}  // namespace
}  // namespace render
