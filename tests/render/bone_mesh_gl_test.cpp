// The mesh view: the triangles lie on the ray-cast surface, are shaded like it and follow carving exactly.
#include <gtest/gtest.h>

#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace render {
namespace {

using testing::ballVolume;
using testing::brickOf;
using testing::frameFor;
using testing::pixelsThatDiffer;
using testing::smallGrid;

const glm::ivec2 kPx{160, 120};

Frame frameOf(ViewMode mode, const glm::dvec3& from = {60, -200, 80}) {
  Frame frame = frameFor(cameraRig({.eye_P_mm = from, .look_at_P_mm = {0, 0, 0}, .fov_y_rad = 0.17}, kPx));
  frame.mode = mode;
  return frame;
}

struct Drawn {
  Image image;
  DistanceImage distance;
};

Drawn drawn(FrameRenderer& renderer, const Frame& frame) {
  renderer.renderEye(frame, Eye::left);
  Drawn result{renderer.readEye(Eye::left), renderer.readDistance(Eye::left)};
  renderer.throwIfError();
  return result;
}

assets::CtVolume twoBalls() { return ballVolume(smallGrid(), {{{0.3, -0.2, 0.1}, 9.0}, {{6.0, 4.0, 7.0}, 5.0}}); }

/// Takes a ball of bone away and returns the bricks that changed.
std::vector<glm::ivec3> carve(assets::CtVolume& ct, const glm::dvec3& bur_P_mm, double radius_mm) {
  std::vector<glm::ivec3> bricks;
  const glm::ivec3 size = ct.grid.size;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const double outside_mm = glm::length(ct.grid.centre_P_mm({i, j, k}) - bur_P_mm) - radius_mm;
        const double keep = std::clamp(0.5 + outside_mm / ct.grid.spacing_mm, 0.0, 1.0);
        std::uint8_t& solid = ct.solid[ct.grid.index({i, j, k})];
        const auto left = std::min(solid, static_cast<std::uint8_t>(std::lround(255.0 * keep)));
        if (left == solid) continue;
        solid = left;
        if (bricks.empty() || bricks.back() != glm::ivec3(i, j, k) / 8) bricks.push_back(glm::ivec3(i, j, k) / 8);
      }
  return bricks;
}

void bring(FrameRenderer& renderer, const assets::CtVolume& ct, const std::vector<glm::ivec3>& bricks) {
  for (const glm::ivec3& brick : bricks)
    renderer.updateBrick(brick, std::span<const std::uint8_t, 512>(brickOf(ct, brick)));
}

TEST(BoneMesh, LiesWhereTheRaysFindTheSurface) {
  const OffscreenContext context;
  const assets::CtVolume ct = twoBalls();
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  for (const glm::dvec3& from : {glm::dvec3(60, -200, 80), glm::dvec3(-150, 30, -150), glm::dvec3(10, 210, 5)}) {
    const Drawn rays = drawn(renderer, frameOf(ViewMode::iso, from));
    const Drawn mesh = drawn(renderer, frameOf(ViewMode::mesh, from));
    int both = 0, one = 0;
    double worst_mm = 0.0;
    for (std::size_t p = 0; p < rays.distance.mm.size(); ++p) {
      const bool by_ray = rays.distance.mm[p] > 0.0f, by_mesh = mesh.distance.mm[p] > 0.0f;
      one += by_ray != by_mesh;
      both += by_ray && by_mesh;
      if (by_ray && by_mesh) worst_mm = std::max(worst_mm, std::abs(double{rays.distance.mm[p]} - mesh.distance.mm[p]));
    }
    EXPECT_GT(both, 2000);
    EXPECT_LT(one, 60);        // of the outline
    EXPECT_LT(worst_mm, 1.5);  // where a ray only grazes; a voxel is 0.5 mm
  }
}

TEST(BoneMesh, IsShadedLikeTheRayCastSurface) {
  const OffscreenContext context;
  const assets::CtVolume ct = twoBalls();
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  const Image rays = drawn(renderer, frameOf(ViewMode::iso)).image;
  const Image mesh = drawn(renderer, frameOf(ViewMode::mesh)).image;
  // The same shading of a surface a hundredth of a voxel away; larger differences are outline pixels.
  EXPECT_LT(pixelsThatDiffer(rays, mesh, 4), 250u);
  EXPECT_GT(pixelsThatDiffer(rays, mesh, 0), 0u);  // control: a different rendering
}

TEST(BoneMesh, AfterCarvingEqualsANewMeshOfTheCarvedBone) {
  const OffscreenContext context;
  assets::CtVolume ct = twoBalls();
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  const Drawn uncarved = drawn(renderer, frameOf(ViewMode::mesh));
  // A groove in several cuts, some of them while another view is drawn.
  for (int cut = 0; cut < 8; ++cut) {
    bring(renderer, ct, carve(ct, {-3.0 + 0.8 * cut, -9.0, 1.0}, 2.0));
    drawn(renderer, frameOf(cut % 3 == 1 ? ViewMode::iso : ViewMode::mesh));
  }
  const Drawn followed = drawn(renderer, frameOf(ViewMode::mesh));
  FrameRenderer fresh(ct.grid, ct.solid, ct.label);
  const Drawn anew = drawn(fresh, frameOf(ViewMode::mesh));
  EXPECT_EQ(pixelsThatDiffer(followed.image, anew.image), 0u);
  EXPECT_EQ(followed.distance.mm, anew.distance.mm);
  EXPECT_GT(pixelsThatDiffer(followed.image, uncarved.image, 8), 200u);
}

TEST(BoneMesh, KeepsEveryPatchWhenItsBuffersGrow) {
  const OffscreenContext context;
  // The surface grows far beyond the initial buffers.
  assets::CtVolume ct = ballVolume(smallGrid(), {{{0, 0, 0}, 3.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  drawn(renderer, frameOf(ViewMode::mesh));
  ct = ballVolume(smallGrid(), {{{0, 0, 0}, 11.0}});
  for (int n = 0; n < 30; ++n) carve(ct, 11.0 * glm::normalize(glm::dvec3(n % 7 - 3, n % 5 - 2.5, n % 3 - 1)), 1.5);
  std::vector<glm::ivec3> all;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) all.push_back({i, j, k});
  bring(renderer, ct, all);
  const Drawn grown = drawn(renderer, frameOf(ViewMode::mesh));
  FrameRenderer fresh(ct.grid, ct.solid, ct.label);
  EXPECT_EQ(grown.distance.mm, drawn(fresh, frameOf(ViewMode::mesh)).distance.mm);
}

TEST(BoneMesh, ShowsNothingWithoutBone) {
  const OffscreenContext context;
  const assets::VolumeGrid grid = smallGrid();
  const std::vector<std::uint8_t> air(grid.voxelCount());
  FrameRenderer renderer(grid, air, {});
  for (const float mm : drawn(renderer, frameOf(ViewMode::mesh)).distance.mm) ASSERT_EQ(mm, 0.0f);
}

}  // namespace
}  // namespace render
