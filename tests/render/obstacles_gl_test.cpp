// Bone in the way of a piece of tooth, on every back-end: where it lies, and nowhere else.
#include <gtest/gtest.h>

#include "render/gpu/offscreen_context.h"
#include "render/scene/obstacle_mesh.h"
#include "tests/render/drawn_scene.h"
#include "tests/render/twin_scene.h"

namespace render {
namespace {

using namespace render::testing;

constexpr glm::ivec2 kPx{160, 120};
constexpr double kVoxel_mm = 0.25;

/// A box of voxels of 2 x 2 x 1 mm around a place.
Obstacles boxAt(const glm::dvec3& middle_P_mm, glm::ivec3 voxels = {8, 8, 4}) {
  Obstacles obstacles{kVoxel_mm, {}};
  assets::forVoxels(glm::ivec3(0), voxels, [&](glm::ivec3 ijk) {
    obstacles.middle_P_mm.emplace_back(middle_P_mm + kVoxel_mm * (glm::dvec3(ijk) - 0.5 * glm::dvec3(voxels - 1)));
  });
  return obstacles;
}

Frame frameOf(const Obstacles& obstacles) {
  Frame frame = frameFor(cameraRig({.eye_P_mm = {60, -240, 40}, .fov_y_rad = 0.06}, kPx));
  frame.obstacles = obstacles;
  return frame;
}

glm::dvec3 lowOf(const assets::MeshPart& part) {
  glm::vec3 low = part.position_mm.front();
  for (const glm::vec3& p : part.position_mm) low = glm::min(low, p);
  return low;
}

TEST(ObstacleMesh, LiesAroundItsVoxelsWithinHalfAVoxel) {
  const assets::MeshModel mesh = obstacleMesh(boxAt({1.0, 2.0, 3.0}));
  ASSERT_EQ(mesh.parts.size(), 1u);
  const glm::dvec3 low = lowOf(mesh.parts[0]);
  for (int axis = 0; axis < 3; ++axis) {
    const double outside_mm = glm::dvec3(0.0, 1.0, 2.5)[axis] - low[axis];
    EXPECT_GT(outside_mm, 0.0);
    EXPECT_LT(outside_mm, 0.5 * kVoxel_mm);
  }
  EXPECT_TRUE(obstacleMesh({}).parts.empty());
}

TEST(ObstacleMesh, ALayerOneVoxelThickIsThere) {
  const assets::MeshModel mesh = obstacleMesh(boxAt({0.0, 0.0, 0.0}, {8, 8, 1}));
  ASSERT_EQ(mesh.parts.size(), 1u);
  EXPECT_GT(mesh.parts[0].triangles.size(), 3u * 64u);
  EXPECT_TRUE(obstacleMesh(boxAt({0.0, 0.0, 0.0}, {1, 1, 1})).parts.empty()) << "a stray voxel is noise";
}

class ObstaclesDrawn : public ::testing::TestWithParam<Backend> {
 protected:
  OffscreenContext context_;
  assets::VolumeGrid grid_ = smallGrid(glm::ivec3(80), kVoxel_mm);
};

Image pictureOf(FrameRenderer& renderer, const Frame& frame) {
  renderer.renderEye(frame, Eye::cyclopean);
  return renderer.readEye(Eye::cyclopean);
}

TEST_P(ObstaclesDrawn, AreSeenThroughTheBoneWhereTheyLie) {
  const auto jaw = ballVolume(grid_, {{{0, 0, 0}, 6.0}});
  FrameRenderer renderer(grid_, jaw.solid, {}, {GetParam()});
  const glm::dvec3 in_bone(1.5, 0.0, 2.0);
  const Frame without = frameOf({}), with = frameOf(boxAt(in_bone));
  const Image before = pictureOf(renderer, without), after = pictureOf(renderer, with);
  const EyeView view = eyeView(with.rig, Eye::cyclopean);
  const glm::dvec2 middle = pixelOf(with.rig, view, in_bone);
  int differ = 0;
  for (int y = 0; y < kPx.y; ++y)
    for (int x = 0; x < kPx.x; ++x) {
      const auto p = static_cast<std::size_t>(4 * (y * kPx.x + x));
      if (std::abs(before.rgba[p] - after.rgba[p]) + std::abs(before.rgba[p + 2] - after.rgba[p + 2]) <= 6) continue;
      ++differ;
      // 2.6 mm across its corners, in pixels of 0.12 mm.
      EXPECT_LT(glm::distance(glm::dvec2(x, y), middle), 15.0);
      EXPECT_LT(after.rgba[p + 2], before.rgba[p + 2]) << "amber has little blue";
    }
  EXPECT_GT(differ, 100);
  Frame hidden = with;
  hidden.layers.obstacles = false;
  EXPECT_EQ(pictureOf(renderer, hidden).rgba, before.rgba) << "a layer that can be switched off";
  EXPECT_EQ(pictureOf(renderer, without).rgba, before.rgba) << "and nothing stays behind";
  EXPECT_EQ(pictureOf(renderer, with).rgba, after.rgba);
}

INSTANTIATE_TEST_SUITE_P(Backends, ObstaclesDrawn,
                         ::testing::Values(Backend::gl_fragment, Backend::gl_compute, Backend::cpu));

TEST(ObstaclesTwin, AreTheSameOnProcessorAndCard) {
  const OffscreenContext context;
  const assets::VolumeGrid grid = smallGrid(glm::ivec3(80), kVoxel_mm);
  const auto jaw = ballVolume(grid, {{{0, 0, 0}, 5.0}});
  for (const bool mirrored : {false, true}) {
    // Half in the ball, half out of it.
    Frame frame = frameOf(boxAt({2.0, -2.0, 4.0}, {20, 8, 8}));
    if (mirrored) frame.rig = throughMirror(frame.rig);
    FrameRenderer gl(grid, jaw.solid, {}), cpu(grid, jaw.solid, {}, {Backend::cpu});
    const Difference d = between(gl, cpu, frame, Eye::left);
    EXPECT_LE(d.beyond, 12) << mirrored;
    EXPECT_LT(d.worst_mm, 0.1);
  }
}

}  // namespace
}  // namespace render
