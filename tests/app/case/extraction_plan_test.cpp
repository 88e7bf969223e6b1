#include "app/case/extraction_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/case/case.h"
#include "app/case/impaction_class.h"
#include "app/text/usage_error.h"
#include "assets/tooth.h"
#include "tests/app/case/block_with_molar.h"

namespace app {
namespace {

using assets::Tissue;

double numberOf(const ExtractionPlan& plan, std::string_view key) {
  const auto* value = std::get_if<double>(&itemOf(plan, key).value);
  EXPECT_NE(value, nullptr) << key << ": " << itemOf(plan, key).how;
  return value ? *value : std::nan("");
}

std::string wordsOf(const ExtractionPlan& plan, std::string_view key) {
  const auto* value = std::get_if<std::string>(&itemOf(plan, key).value);
  EXPECT_NE(value, nullptr) << key << ": " << itemOf(plan, key).how;
  return value ? *value : "";
}

/// The block with both molars numbered; the second one has enamel down to z = -4 mm.
assets::Patient numberedBlock() {
  assets::Patient patient = test::blockWithMolar();
  assets::CtVolume& ct = patient.ct;
  ct.tooth.assign(ct.label.size(), 0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (assets::isToothPart(ct.label[v])) ct.tooth[v] = 48;
    if (Tissue{ct.label[v]} != Tissue::other_teeth) return;
    ct.tooth[v] = 47;
    ct.label[v] = static_cast<std::uint8_t>(ct.grid.centre_P_mm(ijk).z > -4.0 ? Tissue::enamel : Tissue::dentine);
  });
  return patient;
}

/// All parameters come back: angle within 3 degrees, classes exact, distances within 0.3 mm.
TEST(ExtractionPlan, ReadsEveryNamedCaseAsItWasMade) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    assets::JawParameters jaw = one.jaw;
    jaw.spacing_mm = 0.35;
    const ExtractionPlan plan = extractionPlan(assets::syntheticJaw(jaw), std::string(one.name));
    for (const PlanItem& item : plan) EXPECT_TRUE(item.isKnown()) << item.key << ": " << item.how;
    EXPECT_EQ(numberOf(plan, "fdi"), one.fdi());
    EXPECT_NEAR(numberOf(plan, "winter_angle"), one.jaw.winter_angle_deg, 3.0);
    EXPECT_EQ(wordsOf(plan, "winter_class"), nameOf(winterClass(one.jaw.winter_angle_deg)));
    EXPECT_NEAR(numberOf(plan, "depth"), one.jaw.depth_mm, 0.4);
    EXPECT_EQ(wordsOf(plan, "pell_gregory_depth"), std::string(1, pellGregoryPosition(one)));
    EXPECT_EQ(wordsOf(plan, "pell_gregory_ramus"), "II");
    EXPECT_NEAR(numberOf(plan, "canal_distance"), one.jaw.mandibular_canal_distance_mm, 0.3);
    EXPECT_NE(wordsOf(plan, "canal_relation").find(one.jaw.mandibular_canal_distance_mm > 0.0 ? "apart" : "in contact"),
              std::string::npos);
    EXPECT_NEAR(numberOf(plan, "second_molar"), 0.35, 0.3);
    EXPECT_GT(numberOf(plan, "lingual_plate"), 0.0);
    EXPECT_LT(numberOf(plan, "lingual_plate"), 5.0);
    EXPECT_EQ(numberOf(plan, "roots"), 2.0);
    EXPECT_NE(wordsOf(plan, "root_shape").find("to distal"), std::string::npos);
    EXPECT_EQ(numberOf(plan, "difficulty"), pedersonScore(one));
  }
}

TEST(ExtractionPlan, MeasuresABlockByClosedForm) {
  const ExtractionPlan plan = extractionPlan(numberedBlock(), "block");
  EXPECT_NEAR(numberOf(plan, "winter_angle"), 0.0, 1.0);
  EXPECT_EQ(wordsOf(plan, "winter_class"), "vertical");
  EXPECT_NEAR(numberOf(plan, "depth"), 4.0 - test::kMolarTop_mm, 0.51);
  EXPECT_EQ(wordsOf(plan, "pell_gregory_depth"), "B");
  EXPECT_NEAR(numberOf(plan, "second_molar"), 40.0 - test::kSecondMolar_y_mm - 2.0 * test::kMolarRadius_mm, 0.51);
  EXPECT_EQ(numberOf(plan, "roots"), 1.0);
  EXPECT_EQ(wordsOf(plan, "root_shape"), "single or fused");
}

TEST(ExtractionPlan, SaysWhyAValueIsNotKnown) {
  assets::Patient patient = numberedBlock();
  const ExtractionPlan without_canal = extractionPlan(patient, "block");
  EXPECT_FALSE(itemOf(without_canal, "canal_distance").isKnown());
  EXPECT_NE(itemOf(without_canal, "canal_distance").how.find("canal"), std::string::npos);
  EXPECT_NE(itemOf(without_canal, "pell_gregory_ramus").how.find("ramus"), std::string::npos);
  EXPECT_FALSE(itemOf(without_canal, "difficulty").isKnown());

  std::ranges::replace(patient.ct.tooth, std::uint8_t{47}, std::uint8_t{0});
  for (const std::string_view key : {"winter_angle", "winter_class", "depth", "pell_gregory_depth", "second_molar"}) {
    const ExtractionPlan plan = extractionPlan(patient, "block");
    EXPECT_FALSE(itemOf(plan, key).isKnown()) << key;
    EXPECT_NE(itemOf(plan, key).how.find("47"), std::string::npos) << key;
  }
}

TEST(ExtractionPlan, NamesTheDistanceToACanalBelow) {
  assets::Patient patient = numberedBlock();
  patient.mandibular_canal_P_mm = {{-20.0, 20.0, -22.0}, {-20.0, 60.0, -22.0}};
  patient.mandibular_canal_radius_mm = 1.5;
  const ExtractionPlan plan = extractionPlan(patient, "block");
  EXPECT_NEAR(numberOf(plan, "canal_distance"), 22.0 - 18.0 - 1.5, 0.3);
  EXPECT_EQ(wordsOf(plan, "canal_relation"), "below the roots, apart");
}

/// Bone on the tongue's side of the tooth: from its surface to x = -12 mm.
TEST(ExtractionPlan, MeasuresTheLingualPlate) {
  assets::Patient patient = numberedBlock();
  assets::CtVolume& ct = patient.ct;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.grid.centre_P_mm(ijk).x > -12.0) ct.solid[v] = ct.label[v] = 0;
  });
  EXPECT_NEAR(numberOf(extractionPlan(patient, "block"), "lingual_plate"), 3.0, 0.51);
}

TEST(ExtractionPlan, CountsRootsThatPart) {
  assets::Patient patient = numberedBlock();
  assets::CtVolume& ct = patient.ct;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    if (ct.tooth[v] == 48 && p.z < -12.0 && std::abs(p.y - 40.0) < 1.5) {
      ct.tooth[v] = 0;
      ct.label[v] = static_cast<std::uint8_t>(Tissue::cortical);
    }
  });
  const ExtractionPlan plan = extractionPlan(patient, "block");
  EXPECT_EQ(numberOf(plan, "roots"), 2.0);
  EXPECT_EQ(wordsOf(plan, "root_shape"), "parallel");
}

TEST(ExtractionPlan, RefusesWhatHasNoLowerThirdMolar) {
  assets::Patient patient = numberedBlock();
  const auto refusal = [&] {
    try {
      extractionPlan(patient, "block");
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const int fdi : {47, 18, 28}) {
    std::ranges::replace(patient.ct.tooth, static_cast<std::uint8_t>(patient.site->fdi),
                         static_cast<std::uint8_t>(fdi));
    patient.site->fdi = fdi;
    EXPECT_NE(refusal().find("lower third molar"), std::string::npos) << refusal();
  }
  patient.site->fdi = 38;
  EXPECT_NE(refusal().find("no voxel"), std::string::npos) << refusal();
  patient.site.reset();
  EXPECT_NE(refusal().find("no third molar is labelled"), std::string::npos) << refusal();
}

TEST(ImpactionClass, HasTheCutOffsOfTheAuthors) {
  EXPECT_EQ(winterClass(-80.0), Angulation::inverted);
  EXPECT_EQ(winterClass(-11.0), Angulation::disto_angular);
  EXPECT_EQ(winterClass(10.0), Angulation::vertical);
  EXPECT_EQ(winterClass(11.0), Angulation::mesio_angular);
  EXPECT_EQ(winterClass(80.0), Angulation::horizontal);
  EXPECT_EQ(winterClass(101.0), Angulation::inverted);
  EXPECT_EQ(pellGregoryRamus(0.05), 1);
  EXPECT_EQ(pellGregoryRamus(0.5), 2);
  EXPECT_EQ(pellGregoryRamus(0.95), 3);
  EXPECT_EQ(pedersonSum(Angulation::disto_angular, 'C', 3), 10);
  EXPECT_EQ(pedersonSum(Angulation::inverted, 'A', 1), 0);
}

}  // namespace
}  // namespace app
