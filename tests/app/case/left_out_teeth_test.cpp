#include "app/case/left_out_teeth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/tissue.h"

namespace app {
namespace {

/// Two balls of 3 mm, tooth 44 at x = -5 and 45 at x = 5, in bone.
assets::CtVolume twoTeeth() {
  assets::CtVolume ct;
  ct.grid = {{60, 30, 30}, 0.4, {-12.0, -6.0, -6.0}};
  const std::size_t count = ct.grid.voxelCount();
  ct.solid.assign(count, 0), ct.label.assign(count, 0), ct.tooth.assign(count, 0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    if (p.z < -3.5) ct.solid[v] = 255, ct.label[v] = static_cast<std::uint8_t>(assets::Tissue::cortical);
    for (const int fdi : {44, 45}) {
      const double inside_mm = 3.0 - glm::distance(p, glm::dvec3(fdi == 44 ? -5.0 : 5.0, 0.0, 0.0));
      if (inside_mm < -0.2) continue;
      ct.solid[v] = static_cast<std::uint8_t>(255.0 * std::clamp(0.5 + inside_mm / 0.4, 0.0, 1.0));
      ct.tooth[v] = static_cast<std::uint8_t>(fdi);
    }
  });
  return ct;
}

TEST(LeftOutTeeth, AreDrawnWhereTheyStandAndNoOthers) {
  const assets::MeshPart part = leftOutTeeth(twoTeeth(), [](int fdi) { return fdi == 44; });
  ASSERT_GT(part.triangles.size(), 300U);
  ASSERT_EQ(part.normal.size(), part.position_mm.size());
  EXPECT_TRUE(part.name.ends_with("Teeth")) << "shaded as such";
  for (std::size_t n = 0; n < part.position_mm.size(); ++n) {
    const glm::vec3 from = part.position_mm[n] - glm::vec3(-5.0F, 0.0F, 0.0F);
    EXPECT_NEAR(glm::length(from), 3.0F, 0.1F);
    EXPECT_GT(glm::dot(part.normal[n], from), 2.7F) << "outwards";
  }
}

TEST(LeftOutTeeth, AreNoneWhereAllAreInTheRowOrNoneIsNumbered) {
  assets::CtVolume ct = twoTeeth();
  EXPECT_TRUE(leftOutTeeth(ct, [](int) { return false; }).triangles.empty());
  ct.tooth.clear();
  EXPECT_TRUE(leftOutTeeth(ct, [](int) { return true; }).triangles.empty());
}

}  // namespace
}  // namespace app
