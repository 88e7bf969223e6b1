#include "app/case/trough_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/case/gutter_plan.h"
#include "assets/tooth.h"
#include "tests/app/case/block_with_molar.h"

namespace app {
namespace {

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

TEST(PlannedCut, IsTheGutterWhereOneFits) {
  const auto plan = plannedCut(test::blockWithMolar(), 1.5);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->kind, CutKind::gutter);
  EXPECT_EQ(plan->cut.strokes_P_mm, planGutter(test::blockWithMolar(), 1.5)->strokes_P_mm);
}

TEST(PlannedCut, LiesOnTheNearestBoneOfAPatientWithoutASite) {
  assets::Patient patient = test::blockWithMolar();
  patient.site.reset();
  patient.jaw_P_mm = {-10.0, 38.0, -8.0};
  const auto plan = plannedCut(patient, 1.5);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->kind, CutKind::nearest_bone);
  const assets::PlannedCut& cut = plan->cut;
  EXPECT_NEAR(cut.surface_P_mm.z, 0.0, 0.6) << "the block's upper face is what the eye sees";
  EXPECT_LT(glm::distance(cut.surface_P_mm, patient.jaw_P_mm), 20.0);
  EXPECT_GT(cut.outward_P.z, 0.2);
  std::ranges::fill(patient.ct.solid, std::uint8_t{0});
  EXPECT_FALSE(plannedCut(patient, 1.5).has_value());
}

}  // namespace
}  // namespace app
