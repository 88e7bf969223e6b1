#include "app/session/field_clarity.h"

#include <gtest/gtest.h>

namespace app {
namespace {

/// `seconds` at constant cutting, in steps of `dt_s`.
class Site {
 public:
  FieldClarity field;

  void work(double seconds, double cortex_mm3_per_s, double marrow_mm3_per_s, bool irrigating, bool drilling = true,
            double dt_s = 0.01) {
    const double end_s = tick_.t_s + tick_.dt_s + seconds;
    while (tick_.t_s + tick_.dt_s < end_s - 1e-9) {
      tick_.t_s += tick_.dt_s;
      tick_.dt_s = dt_s;
      tick_.drilling = drilling;
      removed(assets::Tissue::cortical) += cortex_mm3_per_s * dt_s;
      removed(assets::Tissue::trabecular) += marrow_mm3_per_s * dt_s;
      field.step(tick_, irrigating);
    }
  }
  void moveTo(const glm::dvec3& p_P_mm) { tick_.proxy_P.mm = p_P_mm; }
  void undoAll() { tick_.removed_total_mm3.fill(0.0); }

 private:
  double& removed(assets::Tissue tissue) { return tick_.removed_total_mm3[static_cast<std::size_t>(tissue)]; }

  haptics::Tick tick_;
};

TEST(FieldClarity, DustGathersInDryCuttingAndWaterClearsIt) {
  Site site;
  site.work(5.0, 1.0, 0.0, false);
  EXPECT_GT(site.field.cover().dust, 0.6);
  EXPECT_LT(site.field.cover().clarity(), 0.5) << "less than half of the cut is seen";
  site.work(3.0, 0.0, 0.0, true);
  EXPECT_LT(site.field.cover().dust, 0.05);
  EXPECT_GT(site.field.cover().clarity(), 0.8);
}

TEST(FieldClarity, CuttingUnderWaterLeavesNoDustAndAWetField) {
  Site site;
  site.work(10.0, 1.0, 0.0, true);
  EXPECT_LT(site.field.cover().dust, 0.01);
  EXPECT_NEAR(site.field.cover().water, 1.0, 1e-3);
  EXPECT_NEAR(site.field.cover().spray, 1.0, 1e-3);
  site.work(10.0, 0.0, 0.0, true, false);
  EXPECT_LT(site.field.cover().spray, 1e-3) << "the pump runs with the motor";
  EXPECT_LT(site.field.cover().water, 0.5) << "sucked off";
}

TEST(FieldClarity, OpenMarrowBleedsUntilItIsRinsed) {
  Site cortex, marrow;
  cortex.work(10.0, 1.0, 0.0, false);
  marrow.work(10.0, 0.0, 1.0, false);
  EXPECT_GT(marrow.field.cover().blood, 3.0 * cortex.field.cover().blood);
  const double welled = marrow.field.cover().blood;
  marrow.work(3.0, 0.0, 0.0, true);
  EXPECT_LT(marrow.field.cover().blood, 0.5 * welled);
  marrow.work(15.0, 0.0, 0.0, false, false);
  EXPECT_GT(marrow.field.cover().blood, 0.9 * welled) << "it wells up again";
}

TEST(FieldClarity, HardlyDependsOnTheLengthOfTheSteps) {
  Site ticks, frames;
  for (Site* site : {&ticks, &frames}) {
    const double dt_s = site == &ticks ? 0.001 : 0.02;
    site->work(2.0, 1.5, 0.5, true, true, dt_s);
    site->work(3.0, 1.0, 1.0, false, true, dt_s);
    site->work(4.0, 0.0, 0.0, false, false, dt_s);
  }
  const FieldCover &a = ticks.field.cover(), &b = frames.field.cover();
  for (const auto share : {&FieldCover::water, &FieldCover::blood, &FieldCover::dust, &FieldCover::spray})
    EXPECT_NEAR(a.*share, b.*share, 0.01);
}

TEST(FieldClarity, FollowsTheBurWhileItCutsAndGrowsWithTheCut) {
  Site site;
  site.moveTo({10.0, 0.0, 0.0});
  site.work(2.0, 0.0, 0.0, true);
  EXPECT_EQ(site.field.centre_P().mm, glm::dvec3(0.0)) << "nothing is cut";
  const double before_mm = site.field.reach_mm();
  site.work(30.0, 2.0, 0.0, true);
  EXPECT_NEAR(site.field.centre_P().mm.x, 10.0, 0.01);
  EXPECT_GT(site.field.reach_mm(), before_mm);
}

TEST(FieldClarity, StaysWithinItsRangeThroughUndo) {
  Site site;
  site.work(20.0, 5.0, 5.0, false);
  site.undoAll();
  site.work(20.0, 0.0, 0.0, false, false);
  const FieldCover& cover = site.field.cover();
  for (const double share : {cover.water, cover.blood, cover.dust, cover.spray, cover.clarity()}) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
  }
  EXPECT_LT(cover.blood, 0.2) << "no marrow is open any more";
}

}  // namespace
}  // namespace app
