#include "app/case/trough_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "assets/tooth.h"

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
  patient.site = {48, {-20.0, 40.0, -3.0}, {0.0, 0.0, 1.0}};
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

TEST(TroughPlan, LiesOnTheBoneNextToTheCrown) {
  const auto plan = planBuccalTrough(blockWithMolar(), 2.0);
  ASSERT_TRUE(plan.has_value());
  EXPECT_NEAR(plan->middle_P_mm.z, 0.0, 0.5) << "on the surface";
  EXPECT_LT(plan->middle_P_mm.x, -24.5) << "buccal of the crown, on the patient's right";
  EXPECT_NEAR(plan->middle_P_mm.y, 40.0, 2.0) << "beside the third molar";
  EXPECT_NEAR(glm::length(plan->outward_P), 1.0, 1e-12);
  EXPECT_GT(plan->outward_P.z, 0.5);
  EXPECT_LT(plan->lateral_P.x, 0.0);
  EXPECT_NEAR(glm::dot(plan->outward_P, plan->lateral_P), 0.0, 1e-9);
}

TEST(TroughPlan, AvoidsTheNeighbouringTooth) {
  const auto plan = planBuccalTrough(blockWithMolar(), 2.0);
  ASSERT_TRUE(plan.has_value());
  const glm::dvec2 neighbour{-20.0, 28.0};
  const glm::dvec3 along = glm::cross(plan->outward_P, plan->lateral_P);
  for (double s = -0.5; s <= 0.5; s += 0.1) {
    const glm::dvec3 p = plan->middle_P_mm + s * plan->length_mm * along;
    EXPECT_GT(glm::distance(glm::dvec2(p), neighbour), 5.0 + 2.0) << "crown and bur";
  }
}

TEST(TroughPlan, IsNoneWithoutBoneOrMolar) {
  assets::Patient no_molar = blockWithMolar();
  no_molar.site.reset();
  EXPECT_FALSE(planBuccalTrough(no_molar, 2.0).has_value());
  assets::Patient no_bone = blockWithMolar();
  no_bone.ct.solid.assign(no_bone.ct.solid.size(), 0);
  EXPECT_FALSE(planBuccalTrough(no_bone, 2.0).has_value());
}

/// A first molar on the left between two others, distinguished by number only.
TEST(TroughPlan, LiesNextToAToothInTheMiddleOfTheRow) {
  assets::Patient patient = blockWithMolar();
  assets::CtVolume& ct = patient.ct;
  ct.grid.origin_P_mm.x = 0.0;
  ct.tooth.assign(ct.label.size(), 0);
  std::ranges::fill(ct.solid, std::uint8_t{0});
  std::ranges::fill(ct.label, std::uint8_t{0});
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i) {
        const glm::dvec3 p = ct.grid.centre_P_mm({i, j, k});
        const std::size_t v = ct.grid.index({i, j, k});
        for (const auto& [fdi, y_mm] : {std::pair{35, 29.0}, {36, 40.0}, {37, 51.0}})
          if (glm::length(glm::dvec2(p.x - 20.0, p.y - y_mm)) < 5.0 && p.z < 3.0)
            ct.tooth[v] = static_cast<std::uint8_t>(fdi);
        if (ct.tooth[v] == 0 && p.z > 0.0) continue;
        ct.solid[v] = 255;
        ct.label[v] = static_cast<std::uint8_t>(ct.tooth[v] != 0 ? Tissue::enamel : Tissue::cortical);
      }
  patient.site = {36, {20.0, 40.0, -3.0}, {0.0, 0.0, 1.0}};
  const auto plan = planBuccalTrough(patient, 1.0);
  ASSERT_TRUE(plan.has_value());
  EXPECT_GT(plan->middle_P_mm.x, 24.5) << "buccal of the crown, on the patient's left";
  EXPECT_NEAR(plan->middle_P_mm.y, 40.0, 4.0);
  const glm::dvec3 along = glm::cross(plan->outward_P, plan->lateral_P);
  EXPECT_GT(std::abs(along.y), 0.95) << "along the row";
}

/// Teeth of a lower arch on a parabola, by typical crown widths; y from the incisors to the back.
glm::dvec3 inArch_P_mm(int fdi) {
  constexpr double kWidth_mm[] = {5.3, 5.9, 6.9, 7.0, 7.1, 11.0, 10.5, 10.0}, kBend_per_mm = 0.06, kStep_mm = 0.001;
  double to_centre_mm = 0.5 * kWidth_mm[assets::positionOf(fdi) - 1], x_mm = 0.0;
  for (int place = 1; place < assets::positionOf(fdi); ++place) to_centre_mm += kWidth_mm[place - 1];
  for (double arc_mm = 0.0; arc_mm < to_centre_mm; x_mm += kStep_mm)
    arc_mm += kStep_mm * std::hypot(1.0, 2.0 * kBend_per_mm * x_mm);
  return {assets::isRight(fdi) ? -x_mm : x_mm, kBend_per_mm * x_mm * x_mm, 0.0};
}

glm::dvec3 distalInArch_P(int fdi) {
  const glm::dvec3 ahead = inArch_P_mm(fdi - 1 + (assets::positionOf(fdi) == 1)), behind = inArch_P_mm(fdi + 1);
  return glm::normalize(behind - ahead);
}

enum class Standing { all, its_quadrant, alone };
constexpr double kWithin25Degrees = 0.906;  ///< cosine

TEST(ArchDirection, FollowsTheArchAtEveryToothWhateverTeethAreMissing) {
  assets::CtVolume ct;
  ct.grid = {{160, 140, 8}, 0.5, {-40.0, -10.0, -2.0}};
  ct.label.assign(ct.grid.voxelCount(), 0);
  for (const int site : {31, 32, 33, 34, 36, 37, 41, 42, 43, 45, 46, 47})
    for (const Standing standing : {Standing::all, Standing::its_quadrant, Standing::alone}) {
      ct.tooth.assign(ct.label.size(), 0);
      for (int fdi = 31; fdi <= 48; ++fdi) {
        if (!assets::isToothNumber(fdi) || (standing == Standing::alone && fdi != site)) continue;
        if (standing == Standing::its_quadrant && assets::quadrantOf(fdi) != assets::quadrantOf(site)) continue;
        const glm::dvec3 centre = inArch_P_mm(fdi);
        for (int k = 0; k < ct.grid.size.z; ++k)
          for (int j = 0; j < ct.grid.size.y; ++j)
            for (int i = 0; i < ct.grid.size.x; ++i)
              if (glm::distance(glm::dvec2(ct.grid.centre_P_mm({i, j, k})), glm::dvec2(centre)) < 3.0)
                ct.tooth[ct.grid.index({i, j, k})] = static_cast<std::uint8_t>(fdi);
      }
      const glm::dvec3 found = archDirection_P(ct, {site, inArch_P_mm(site), {0.0, 0.0, 1.0}});
      EXPECT_GT(glm::dot(found, distalInArch_P(site)), kWithin25Degrees)
          << site << ", case " << static_cast<int>(standing);
    }
}

TEST(PlannedCut, IsTheTroughWhereOneFits) {
  const auto plan = plannedCut(blockWithMolar(), 2.0);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->kind, CutKind::buccal_trough);
  EXPECT_EQ(plan->cut.middle_P_mm, planBuccalTrough(blockWithMolar(), 2.0)->middle_P_mm);
}

TEST(PlannedCut, LiesOnTheNearestBoneOfAPatientWithoutASite) {
  assets::Patient patient = blockWithMolar();
  patient.site.reset();
  patient.jaw_P_mm = {-10.0, 38.0, -8.0};
  const auto plan = plannedCut(patient, 1.5);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->kind, CutKind::nearest_bone);
  const assets::PlannedCut& cut = plan->cut;
  EXPECT_NEAR(cut.middle_P_mm.z, 0.0, 0.6) << "the block's upper face is what the eye sees";
  EXPECT_LT(glm::distance(cut.middle_P_mm, patient.jaw_P_mm), 20.0);
  EXPECT_GT(cut.outward_P.z, 0.2);
  std::ranges::fill(patient.ct.solid, std::uint8_t{0});
  EXPECT_FALSE(plannedCut(patient, 1.5).has_value());
}

}  // namespace
}  // namespace app
