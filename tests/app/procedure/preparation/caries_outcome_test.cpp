// An excavation in closed form: a cylinder of caries under the enamel of a round tooth, over a round pulp.
#include <gtest/gtest.h>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "tests/app/procedure/preparation/round_tooth.h"

namespace app::round_tooth {
namespace {

constexpr double kSoft_mm = 0.7, kFirm_mm = 1.1, kDeep_mm = 4.5, kFirmDeep_mm = 4.0, kPulpTop_mm = 2.0;

/// Soft caries of 0.7 mm from 4.5 mm to the enamel, firm around of 1.1 mm from 4.0; the pulp's top at 2 mm.
assets::Tissue tissueAt(const glm::dvec3& p) {
  const double r = std::hypot(p.x, p.y);
  if (intact_mm(p) < 0.0) return assets::Tissue::unlabelled;
  if (glm::length(p - glm::dvec3(0.0, 0.0, kPulpTop_mm - 1.0)) < 1.0) return assets::Tissue::pulp;
  if (intact_mm(p) < kEnamel_mm) return assets::Tissue::enamel;
  if (r < kSoft_mm && p.z > kDeep_mm) return assets::Tissue::caries_soft;
  if (r < kFirm_mm && p.z > kFirmDeep_mm) return assets::Tissue::caries_firm;
  return assets::Tissue::dentine;
}
double solid_mm(const glm::dvec3& p) {
  return std::min(intact_mm(p), glm::length(p - glm::dvec3(0.0, 0.0, kPulpTop_mm - 1.0)) - 1.0);
}

struct Carious {
  assets::ToothFrame frame = round_tooth::frame(false);
  assets::VolumeGrid grid = shapes::gridOf(glm::dvec3(-6.0, -6.0, -2.0), glm::dvec3(6.0, 6.0, 8.0), 0.05);
  Crown crown{ToothBlocks(shapes::ShapeTooth(
                  grid, [this](const glm::dvec3& p_P) { return solid_mm(frame.local(p_P)); },
                  [this](const glm::dvec3& p_P) { return tissueAt(frame.local(p_P)); })),
              frame};

  /// A round cavity down to a height.
  BoxBytes drilled(double radius_mm, double to_mm) const {
    BoxBytes made(crown.solid.grid());
    assets::forVoxels(made.grid(), [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = frame.local(made.grid().centre_P_mm(ijk));
      const double hole_mm = std::min(radius_mm - std::hypot(p.x, p.y), p.z - to_mm);
      made.bytes()[v] = shapes::bytesOf(std::min(solid_mm(p), -hole_mm), grid.spacing_mm);
    });
    return made;
  }
};

double cylinder_mm3(double radius_mm, double height_mm) { return std::numbers::pi * radius_mm * radius_mm * height_mm; }

TEST(CariesOutcome, AnExcavationHasItsVolumes) {
  const Carious tooth;
  const CariesMeasure measure(tooth.crown);
  ASSERT_TRUE(measure.isThere());
  const CariesOutcome untouched = measure.outcomeOf(tooth.crown, tooth.crown.solid);
  const double soft_mm3 = cylinder_mm3(kSoft_mm, 1.5), firm_mm3 = cylinder_mm3(kFirm_mm, 2.0) - soft_mm3;
  EXPECT_NEAR(untouched.soft_before_mm3, soft_mm3, 0.03);
  EXPECT_NEAR(untouched.firm_before_mm3, firm_mm3, 0.05);
  EXPECT_EQ(untouched.soft_left_mm3, untouched.soft_before_mm3);
  EXPECT_EQ(untouched.sound_cut_mm3, 0.0);
  EXPECT_TRUE(std::isnan(untouched.least_over_pulp_mm));

  // Of 1.2 mm radius to 5 mm height: half a millimetre of each is left below, the firm ring above is gone.
  const CariesOutcome half = measure.outcomeOf(tooth.crown, tooth.drilled(1.2, 5.0));
  EXPECT_NEAR(half.soft_left_mm3, cylinder_mm3(kSoft_mm, 0.5), 0.03);
  EXPECT_NEAR(half.firm_left_mm3, firm_mm3 - (cylinder_mm3(kFirm_mm, 1.0) - cylinder_mm3(kSoft_mm, 1.0)), 0.05);
  EXPECT_NEAR(half.sound_cut_mm3, cylinder_mm3(1.2, 2.0) - cylinder_mm3(kFirm_mm, 1.0), 0.08);
  EXPECT_NEAR(half.least_over_pulp_mm, 5.0 - kPulpTop_mm, 0.06);

  const CariesOutcome through = measure.outcomeOf(tooth.crown, tooth.drilled(1.2, 1.5));
  EXPECT_LT(through.soft_left_mm3, 0.01);
  EXPECT_NEAR(through.least_over_pulp_mm, 0.0, 1e-6);
}

TEST(CariesOutcome, ASoundToothHasNone) {
  const Scene scene(0.1);
  EXPECT_FALSE(CariesMeasure(scene.crown).isThere());
}

TEST(CariesOutcome, SoftCariesIsToGoAndFirmMayStay) {
  const Carious tooth;
  IdealRule shallow = idealRule("class-1", "--ideal");
  shallow.depth_mm = 1.0;  // ends at the dentine: the rule alone takes no caries
  const PreparationMeasure measure(tooth.crown, shallow, "--ideal");
  const double soft_mm3 = cylinder_mm3(kSoft_mm, 1.5);
  const PreparationOutcomes untouched = measure.outcomesOf(tooth.crown.solid);
  const PreparationOutcomes narrow = measure.outcomesOf(tooth.drilled(kFirm_mm, kFirmDeep_mm));
  // The groove of 1.5 mm within a circle of 1.1 mm.
  const double half_mm = 0.75, groove_mm2 = 2.0 * (half_mm * std::sqrt(kFirm_mm * kFirm_mm - half_mm * half_mm) +
                                                   kFirm_mm * kFirm_mm * std::asin(half_mm / kFirm_mm));
  EXPECT_NEAR(untouched.removed.under_mm3() - narrow.removed.under_mm3(), soft_mm3 + groove_mm2, 0.3);
  EXPECT_NEAR(narrow.removed.over_mm3(), cylinder_mm3(kFirm_mm, 1.0) - groove_mm2, 0.3)
      << "firm caries that was cut is not too much";
  ASSERT_TRUE(narrow.caries && untouched.caries);
  EXPECT_LT(narrow.caries->soft_left_mm3, 0.02);
  EXPECT_LT(narrow.caries->firm_left_mm3, 0.15);
}

}  // namespace
}  // namespace app::round_tooth
