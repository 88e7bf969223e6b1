#include "assets/scan/hard_tissue.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assets/mesh/bone_surface.h"
#include "assets/tissue.h"
#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

/// A 3 mm ball of tooth half inside a block of bone whose top is z = 0.
struct ToothInBone {
  VolumeGrid grid{{49, 50, 51}, 0.2, {-4.8, -4.9, -5.0}};
  std::vector<std::uint8_t> solid{std::vector<std::uint8_t>(grid.voxelCount())}, label = solid;

  ToothInBone() {
    for (int k = 0; k < grid.size.z; ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) {
          const glm::dvec3 p = grid.centre_P_mm({i, j, k});
          const double tooth_mm = glm::length(p) - 3.0, bone_mm = p.z;
          const double part = 0.5 - std::min(tooth_mm, bone_mm) / grid.spacing_mm;
          const std::size_t n = grid.index({i, j, k});
          solid[n] = static_cast<std::uint8_t>(255.0 * glm::clamp(part, 0.0, 1.0));
          label[n] = static_cast<std::uint8_t>(tooth_mm < 0.0  ? Tissue::dentine
                                               : bone_mm < 0.0 ? Tissue::cortical
                                                               : Tissue::unlabelled);
        }
  }
  std::vector<std::uint8_t> of(HardTissue tissue) const { return solidOf(tissue, grid, solid, label); }
  MeshPart surfaceOf(HardTissue tissue) const {
    const auto field = of(tissue);
    return BoneSurface(SolidVoxels::inGridOrder(grid, field)).mergedMesh("");
  }
};

TEST(HardTissue, GivesAToothASmoothSurface) {
  const ToothInBone scene;
  const MeshPart tooth = scene.surfaceOf(HardTissue::tooth);
  EXPECT_EQ(test::opennessOf(tooth.triangles), "");
  EXPECT_EQ(test::eulerCharacteristic(tooth.triangles), 2);
  // Exact in the air; inside the bone limited by the labels.
  for (const glm::vec3& p : tooth.position_mm) {
    ASSERT_NEAR(glm::length(p), 3.0f, p.z > 0.6f ? 0.03f : 0.16f) << p.z;
  }
  EXPECT_NEAR(test::volume(tooth), 113.1, 2.5);
}

TEST(HardTissue, KeepsTheSurfaceInTheAir) {
  const ToothInBone scene;
  const auto tooth = scene.of(HardTissue::tooth), bone = scene.of(HardTissue::bone);
  int compared = 0;
  for (int k = 29; k < scene.grid.size.z; ++k)
    for (int j = 0; j < scene.grid.size.y; ++j)
      for (int i = 0; i < scene.grid.size.x; ++i) {
        const std::size_t n = scene.grid.index({i, j, k});
        ASSERT_LE(std::abs(tooth[n] - scene.solid[n]), 8) << i << " " << j << " " << k;
        ASSERT_LT(bone[n], 64);
        compared += scene.solid[n] > 0;
      }
  EXPECT_GT(compared, 1000);
}

TEST(HardTissue, DividesAllSolidBetweenBoneAndTooth) {
  const ToothInBone scene;
  const auto tooth = scene.of(HardTissue::tooth), bone = scene.of(HardTissue::bone);
  double whole = 0.0, parts = 0.0;
  for (std::size_t n = 0; n < tooth.size(); ++n) {
    ASSERT_GE(tooth[n] + bone[n], scene.solid[n] - 1);
    whole += scene.solid[n] > 127;
    parts += (tooth[n] > 127) + (bone[n] > 127);
  }
  EXPECT_NEAR(parts / whole, 1.0, 0.01);
}

TEST(HardTissue, IsAllBoneWithoutLabels) {
  const ToothInBone scene;
  EXPECT_EQ(solidOf(HardTissue::bone, scene.grid, scene.solid, {}), scene.solid);
  const auto tooth = solidOf(HardTissue::tooth, scene.grid, scene.solid, {});
  EXPECT_EQ(std::ranges::count(tooth, 0), std::ssize(tooth));
}

TEST(HardTissue, CountsEveryToothTissueAsTooth) {
  for (const Tissue tissue : {Tissue::other_teeth, Tissue::enamel, Tissue::dentine, Tissue::pulp})
    EXPECT_TRUE(belongsTo(static_cast<std::uint8_t>(tissue), HardTissue::tooth));
  for (const Tissue tissue : {Tissue::cortical, Tissue::trabecular, Tissue::mandibular_canal})
    EXPECT_TRUE(belongsTo(static_cast<std::uint8_t>(tissue), HardTissue::bone));
}

}  // namespace
}  // namespace assets
