// P9: cavities cut as boxes in a round tooth with a flat top, against their measures (reference/sisters 5.3).
#include <gtest/gtest.h>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "app/text/usage_error.h"
#include "tests/app/procedure/preparation/round_tooth.h"

namespace app::round_tooth {
namespace {

const Scene& scene() {
  static const Scene kScene(0.05, true);
  return kScene;
}

/// 4 x 1.5 x 2 mm, its walls opening by `degrees` each.
shapes::Depth boxCavity(double degrees = 0.0, double width_mm = 1.5) {
  return [=](const glm::dvec3& p) {
    const double over_mm = std::max(0.0, p.z - 5.0);
    const double half_mm = 0.5 * width_mm + over_mm * std::tan(degrees * kDegree);
    const double cavity_mm = std::min(std::min(2.0 - std::abs(p.x), half_mm - std::abs(p.y)), p.z - 5.0);
    return std::min(intact_mm(p), -cavity_mm);
  };
}

CavityForm formOf(const shapes::Depth& depth, std::string_view rule) {
  return cavityForm(scene().crown, scene().made(depth), idealRule(rule, "--ideal"));
}

TEST(Cavity, ABoxHasItsMeasures) {
  const CavityForm form = formOf(boxCavity(), "class-1");
  EXPECT_NEAR(form.depth_mm, 2.0, 0.01);
  EXPECT_NEAR(form.isthmus_mm, 1.5, 0.01);
  EXPECT_NEAR(form.least_isthmus_mm, 1.5, 0.02);
  EXPECT_NEAR(form.length_mm, 4.0, 0.01);
  EXPECT_NEAR(form.divergence_rad / kDegree, 0.0, 0.3);
  EXPECT_EQ(form.box_axial_mm, 0.0);
}

TEST(Cavity, WallsThatOpenDiverge) {
  EXPECT_NEAR(formOf(boxCavity(4.0), "class-1").divergence_rad / kDegree, 8.0, 0.3);
  EXPECT_NEAR(formOf(boxCavity(-4.0), "class-1").divergence_rad / kDegree, -8.0, 0.3);
}

TEST(Cavity, AnUncutToothHasNone) { EXPECT_FALSE(formOf(intact_mm, "class-1").isCut()); }

TEST(Cavity, ABoxAtTheSideHasAxialDepthWidthAndHeight) {
  const auto groove = boxCavity();
  for (const double side : {1.0, -1.0}) {
    const auto depth = [&](const glm::dvec3& p) {
      const double along = side * p.x;
      const double box_mm = std::min(std::min(along - 3.5, 1.5 - std::abs(p.y)), p.z - 2.0);
      const double through_mm = std::min(std::min(along, 0.75 - std::abs(p.y)), p.z - 5.0);
      return std::min(groove(p), -std::max(box_mm, through_mm));
    };
    const CavityForm form = formOf(depth, side > 0.0 ? "class-2:mesial" : "class-2:distal");
    EXPECT_NEAR(form.depth_mm, 2.0, 0.02);
    EXPECT_NEAR(form.box_axial_mm, 1.5, 0.01);
    EXPECT_NEAR(form.box_width_mm, 3.0, 0.02);
    EXPECT_NEAR(form.box_height_mm, 2.0, 0.02);
  }
}

TEST(Cavity, EnamelOnDentineIsSupported) {
  // Enamel is 1 mm thick; the walls' upper millimetre is enamel with dentine behind it only where the side is near.
  const CavityForm form = formOf(boxCavity(), "class-1");
  // Upright walls in enamel: 1 mm high around 11 mm; behind them lies enamel for more than 1.5 mm.
  EXPECT_NEAR(form.unsupported_mm2, 11.0, 0.8);
  // A cavity that stays in enamel stands on dentine 0.6 mm below its floor.
  const auto shallow = [](const glm::dvec3& p) {
    return std::min(intact_mm(p), -std::min(2.0 - std::hypot(p.x, p.y), p.z - 6.6));
  };
  EXPECT_LT(formOf(shallow, "class-1").unsupported_mm2, 2.0 * std::numbers::pi * 2.0 * 0.4 + 0.6);
}

TEST(Cavity, TheIdealMeetsItsOwnRule) {
  for (const char* name : {"class-1", "class-2:mesial", "class-2:distal"}) {
    const IdealRule& rule = idealRule(name, "--ideal");
    const PreparationMeasure measure(scene().crown, rule, "--ideal");
    const PreparationOutcomes outcomes = measure.outcomesOf(measure.ideal());
    EXPECT_NEAR(outcomes.cavity->depth_mm, rule.depth_mm, 0.1) << name;
    EXPECT_NEAR(outcomes.cavity->isthmus_mm, rule.isthmus_mm, 0.02) << name;
    EXPECT_EQ(outcomes.removed.over_mm3() + outcomes.removed.under_mm3(), 0.0) << name;
    EXPECT_GT(outcomes.deviation.within[0], 0.99) << name;
    if (rule.box_side == 0) continue;
    EXPECT_NEAR(outcomes.cavity->box_axial_mm, rule.box_axial_mm, 0.05) << name;
    EXPECT_NEAR(outcomes.cavity->box_width_mm, rule.box_mm, 0.05) << name;
    EXPECT_NEAR(outcomes.cavity->box_height_mm, rule.box_height_mm, 0.05) << name;
  }
}

TEST(Cavity, OneBiggerThanTheToothIsRefused) {
  IdealRule rule = idealRule("class-1", "--ideal");
  rule.isthmus_mm = 6.0;
  EXPECT_THROW(PreparedIdeal(scene().crown, rule, "--ideal"), UsageError);
}

}  // namespace
}  // namespace app::round_tooth
