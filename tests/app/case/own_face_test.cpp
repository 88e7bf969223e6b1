#include "app/case/own_face.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

constexpr double kRadius_mm = 55.0;
const glm::dvec3 kMiddle_P_mm{70.0, 72.0, 68.0}, kToEye_P{0.0, -1.0, 0.0};

/// A head that is a ball, with a narrow nostril, a cave inside and a headrest behind.
assets::CtVolume ball() {
  assets::CtVolume ct;
  ct.grid = {{140, 140, 140}, 1.0, {0, 0, 0}};
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk), from_middle = p - kMiddle_P_mm;
    const bool is_nostril = std::hypot(from_middle.x, from_middle.z - 20.0) < 2.0 && from_middle.y < 0.0;
    const bool is_cave = glm::length(from_middle) < 15.0;
    const bool is_rest = p.y > 133.0;
    const bool is_flesh = (glm::length(from_middle) < kRadius_mm && !is_nostril && !is_cave) || is_rest;
    ct.hounsfield.push_back(is_flesh ? 40 : -1000);
  });
  return ct;
}

TEST(OwnFace, IsTheSkinAloneOpenOverTheSite) {
  const glm::dvec3 site_P_mm = kMiddle_P_mm + glm::dvec3(10.0, -20.0, -10.0);
  const assets::MeshModel face = app::ownFace(ball(), site_P_mm, kToEye_P);
  ASSERT_EQ(face.parts.size(), 1u);
  const assets::MeshPart& skin = face.parts[0];
  EXPECT_EQ(skin.name, "Face");
  EXPECT_GT(skin.triangles.size(), 3000u);
  std::size_t outer = 0;
  for (const glm::vec3& vertex : skin.position_mm) {
    const glm::dvec3 p(vertex), from_site = p - site_P_mm;
    const double from_middle_mm = glm::length(p - kMiddle_P_mm);
    // A shell of 3 mm, on the ball to half a voxel and the smoothing.
    ASSERT_LT(from_middle_mm, kRadius_mm + 1.2);
    ASSERT_GT(from_middle_mm, kRadius_mm - 3.0 - 1.2);
    const double aside_mm = glm::length(glm::dvec2(from_site.x, from_site.z));
    if (from_site.y < 0.0) {
      ASSERT_GT(aside_mm, 23.0);
    }
    outer += std::abs(from_middle_mm - kRadius_mm) < 0.8 ? 1 : 0;
  }
  EXPECT_GT(outer, skin.position_mm.size() / 3);
}

TEST(OwnFace, IsNoneWhereTheScanShowsNoSkin) {
  assets::CtVolume ct;
  ct.grid = {{60, 60, 60}, 1.0, {0, 0, 0}};
  ct.hounsfield.assign(ct.grid.voxelCount(), 40);  // a field of view within the head
  EXPECT_TRUE(app::ownFace(ct, {30, 30, 30}, kToEye_P).parts.empty());
  ct.hounsfield.assign(ct.grid.voxelCount(), -1000);
  EXPECT_TRUE(app::ownFace(ct, {30, 30, 30}, kToEye_P).parts.empty());
}

}  // namespace
