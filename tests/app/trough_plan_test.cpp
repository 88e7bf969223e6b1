#include "app/trough_plan.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using assets::Tissue;

/// A block of bone up to z = 0 with a third molar standing in it, right side.
assets::Patient blockWithMolar() {
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {{80, 80, 60}, 0.5, {-40.0, 20.0, -24.0}};
  ct.solid.assign(ct.grid.voxelCount(), 0);
  ct.label.assign(ct.grid.voxelCount(), 0);
  patient.site = {true, 48, {-20.0, 40.0, -3.0}, {0.0, 0.0, 1.0}};
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i) {
        const glm::dvec3 p = ct.grid.centre_P_mm({i, j, k});
        const bool molar = glm::length(glm::dvec2(p.x + 20.0, p.y - 40.0)) < 5.0 && p.z < 3.0;
        const bool neighbour = glm::length(glm::dvec2(p.x + 20.0, p.y - 28.0)) < 5.0 && p.z < 3.0;
        if (!molar && !neighbour && p.z > 0.0) continue;
        ct.solid[ct.grid.index({i, j, k})] = 255;
        ct.label[ct.grid.index({i, j, k})] = static_cast<std::uint8_t>(molar       ? Tissue::enamel
                                                                       : neighbour ? Tissue::other_teeth
                                                                                   : Tissue::cortical);
      }
  return patient;
}

TEST(TroughPlan, LiesOnTheBoneBesideTheCrown) {
  const auto plan = planBuccalTrough(blockWithMolar(), 2.0);
  ASSERT_TRUE(plan.has_value());
  EXPECT_NEAR(plan->site_D.mm.z, 0.0, 0.5) << "on the surface";
  EXPECT_LT(plan->site_D.mm.x, -24.5) << "buccal of the crown, on the patient's right";
  EXPECT_NEAR(plan->site_D.mm.y, 40.0, 2.0) << "beside the third molar";
  EXPECT_NEAR(glm::length(plan->outward_D.xyz), 1.0, 1e-12);
  EXPECT_GT(plan->outward_D.xyz.z, 0.5);
  EXPECT_LT(plan->buccal_D.xyz.x, 0.0);
  EXPECT_NEAR(glm::dot(plan->outward_D.xyz, plan->buccal_D.xyz), 0.0, 1e-9);
}

TEST(TroughPlan, KeepsOffTheNeighbouringTooth) {
  const auto plan = planBuccalTrough(blockWithMolar(), 2.0);
  ASSERT_TRUE(plan.has_value());
  const glm::dvec2 neighbour{-20.0, 28.0};
  const glm::dvec3 along = glm::cross(plan->outward_D.xyz, plan->buccal_D.xyz);
  for (double s = -0.5; s <= 0.5; s += 0.1) {
    const glm::dvec3 p = plan->site_D.mm + s * plan->stroke_mm * along;
    EXPECT_GT(glm::distance(glm::dvec2(p), neighbour), 5.0 + 2.0) << "crown and bur";
  }
}

TEST(TroughPlan, IsNoneWithoutBoneOrMolar) {
  assets::Patient no_molar = blockWithMolar();
  no_molar.site.known = false;
  EXPECT_FALSE(planBuccalTrough(no_molar, 2.0).has_value());
  assets::Patient no_bone = blockWithMolar();
  no_bone.ct.solid.assign(no_bone.ct.solid.size(), 0);
  EXPECT_FALSE(planBuccalTrough(no_bone, 2.0).has_value());
}

}  // namespace
}  // namespace app
