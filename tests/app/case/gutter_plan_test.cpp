#include "app/case/gutter_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/case/enamel_exposure.h"
#include "assets/cut_field.h"
#include "tests/app/case/block_with_molar.h"

namespace app {
namespace {

using test::blockWithMolar;

/// visit(centre of the bur) along every stroke.
template <class Visit>
void alongStrokes(const assets::PlannedCut& cut, const Visit& visit) {
  for (const auto& stroke : cut.strokes_P_mm)
    for (std::size_t n = 0; n + 1 < stroke.size(); ++n)
      for (double t = 0.0; t <= 1.0; t += 0.1) visit(glm::mix(stroke[n], stroke[n + 1], t));
}

TEST(GutterPlan, NeverTouchesTheToothAndKeepsHalfAMillimetreOffTheSecondMolar) {
  const assets::Patient patient = blockWithMolar();
  std::vector<glm::dvec3> molar;
  assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (assets::isToothPart(patient.ct.label[v])) molar.push_back(patient.ct.grid.centre_P_mm(ijk));
  });
  for (const double radius_mm : {0.8, 1.15, 1.5, 2.0}) {
    const auto cut = planGutter(patient, radius_mm);
    ASSERT_TRUE(cut.has_value()) << radius_mm;
    double from_molar_mm = 1e9, from_second_mm = 1e9, lowest_mm = 1e9;
    alongStrokes(*cut, [&](const glm::dvec3& p) {
      for (const glm::dvec3& voxel : molar) from_molar_mm = std::min(from_molar_mm, glm::distance(p, voxel));
      const glm::dvec2 second(-20.0, test::kSecondMolar_y_mm);
      from_second_mm = std::min(from_second_mm, glm::distance(glm::dvec2(p), second) - test::kMolarRadius_mm);
      lowest_mm = std::min(lowest_mm, p.z - radius_mm);
    });
    EXPECT_GT(from_molar_mm, radius_mm + 0.1) << radius_mm;
    EXPECT_GE(from_second_mm, radius_mm + 0.5) << radius_mm;
    EXPECT_NEAR(lowest_mm, test::kCervix_mm, 1.0) << "down to the cervical line, bur " << radius_mm;
  }
}

/// On a level half way down the crown: a thin bur makes the gutter wider than itself, a thick one as wide as itself.
TEST(GutterPlan, LeavesNoWallBesideTheCrownAndIsTwoToThreeMillimetresWideOrAsTheBur) {
  const assets::Patient patient = blockWithMolar();
  for (const double bur_radius_mm : {0.8, 1.15, 1.5}) {
    const auto cut = planGutter(patient, bur_radius_mm);
    ASSERT_TRUE(cut.has_value());
    const assets::CutField field(*cut, 1.0, false, 0.2);
    for (const double from_buccal_deg : {0.0, 20.0, 40.0, 60.0}) {
      // Buccal is -x on the right side, distal +y.
      const double turn = from_buccal_deg * 3.14159265 / 180.0;
      const glm::dvec3 out(-std::cos(turn), std::sin(turn), 0.0);
      double first_mm = 1e9, width_mm = 0.0;
      for (double off_mm = 0.05; off_mm < 6.0; off_mm += 0.05)
        if (field.contains(glm::dvec3(-20.0, 40.0, -5.0) + (test::kMolarRadius_mm + off_mm) * out)) {
          first_mm = std::min(first_mm, off_mm);
          width_mm += 0.05;
        }
      EXPECT_LT(first_mm, 0.3) << bur_radius_mm << " " << from_buccal_deg;
      EXPECT_GT(width_mm, 2.0) << bur_radius_mm << " " << from_buccal_deg;
      // Voxels of 0.5 mm and columns of 0.3 mm round outwards.
      EXPECT_LT(width_mm, std::max(3.0, 2.0 * bur_radius_mm) + 0.8) << bur_radius_mm << " " << from_buccal_deg;
    }
  }
}

TEST(GutterPlan, KeepsTheLingualSide) {
  const auto cut = planGutter(blockWithMolar(), kUsualBurRadius_mm);
  ASSERT_TRUE(cut.has_value());
  alongStrokes(*cut, [](const glm::dvec3& p) { EXPECT_LT(p.x, -20.0 + 4.0); });
}

TEST(GutterPlan, ComesFartherFromTheFrontToACrownThatLeans) {
  const auto forward = [](const glm::dvec3& axis_P) {
    assets::Patient patient = blockWithMolar();
    patient.site->axis_P = glm::normalize(axis_P);
    const glm::dvec3 outward = planGutter(patient, kUsualBurRadius_mm).value().outward_P;
    return -outward.y / outward.z;  // anterior is -y
  };
  EXPECT_NEAR(forward({0.0, 0.0, 1.0}), 0.3, 0.05);
  EXPECT_NEAR(forward({0.0, -1.0, 4.0}), 0.52, 0.05);
  for (const double lean : {-1.0, 1.0}) EXPECT_NEAR(forward({0.0, lean, 1.0}), 0.75, 0.05) << lean;
}

TEST(GutterPlan, IsNoneWithoutBoneOrMolar) {
  assets::Patient no_site = blockWithMolar();
  no_site.site.reset();
  EXPECT_FALSE(planGutter(no_site, 1.5).has_value());
  assets::Patient no_bone = blockWithMolar();
  std::ranges::fill(no_bone.ct.solid, std::uint8_t{0});
  EXPECT_FALSE(planGutter(no_bone, 1.5).has_value());
}

TEST(EnamelExposure, IsNothingBeforeAllAfterThePlanAndGrowsWithWhatIsRemoved) {
  const assets::Patient patient = blockWithMolar();
  const auto cut = planGutter(patient, kUsualBurRadius_mm);
  ASSERT_TRUE(cut.has_value());
  const EnamelExposure exposure(patient.ct, patient.ct.solid, *patient.site, *cut);
  EXPECT_GT(exposure.planned_mm2(), 10.0);
  EXPECT_EQ(exposure.share(patient.ct.solid), 0.0);

  const assets::CutField field(*cut, 1.0);
  std::vector<std::uint8_t> solid = patient.ct.solid;
  double former = 0.0;
  for (double front_mm = 30.0; front_mm < 52.0; front_mm += 4.0) {
    assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = patient.ct.grid.centre_P_mm(ijk);
      if (p.y < front_mm && field.contains(p)) solid[v] = 0;
    });
    EXPECT_GE(exposure.share(solid), former);
    former = exposure.share(solid);
  }
  EXPECT_EQ(former, 1.0);
}

}  // namespace
}  // namespace app
