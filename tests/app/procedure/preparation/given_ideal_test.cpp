// Ideals from files: as a volume and as a mesh they measure as the rule they were made by; what is no ideal is refused.
#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "app/text/usage_error.h"
#include "tests/app/procedure/preparation/round_tooth.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace app::round_tooth {
namespace {

using testing::HasSubstr;

const Scene& coarse() {
  static const Scene kScene(0.08, true);
  return kScene;
}
shapes::Depth wanted() { return stump(4.0, 6.0, 5.0); }

assets::PreparedTooth preparedBy(assets::GivenIdeal given) {
  return {46, coarse().frame, assets::kGivenIdeal, "", std::move(given)};
}
assets::GivenIdeal givenBy(const shapes::Depth& depth) {
  return givenIdeal(coarse().made(depth), coarse().crown, std::string(64, 'a'), "--ideal f");
}
std::string refusalOf(const shapes::Depth& depth) {
  return tests::refusalOf<UsageError>([&] { givenBy(depth); });
}

class GivenIdealFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& bytes) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  /// Of a depth of the tooth's frame, on voxels of their own.
  static std::string volume(const shapes::Depth& depth, double spacing_mm, int full) {
    const glm::dvec3 low(-7.03, -7.01, -2.02);
    const glm::ivec3 size(glm::ceil(glm::dvec3(14.0, 14.0, 10.5) / spacing_mm));
    std::string bytes =
        "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: " + std::to_string(size.x) + " " +
        std::to_string(size.y) + " " + std::to_string(size.z) + "\nspace directions: (" + std::to_string(spacing_mm) +
        ",0,0) (0," + std::to_string(spacing_mm) + ",0) (0,0," + std::to_string(spacing_mm) +
        ")\nencoding: raw\nspace origin: (-7.03,-7.01,-2.02)\n\n";
    const auto depth_P = coarse().inP(depth);
    assets::forVoxels(glm::ivec3(0), size, [&](glm::ivec3 ijk) {
      const double mm = depth_P(low + spacing_mm * glm::dvec3(ijk));
      bytes += static_cast<char>(full == 1 ? (mm > 0.0 ? 1 : 0) : shapes::bytesOf(mm, spacing_mm));
    });
    return bytes;
  }
  /// A frustum on a disc, turned about the tooth's axis, as its closed surface.
  static std::string mesh(double radius_mm, double degrees, double height_mm, bool is_closed = true) {
    constexpr int kAround = 720;
    const double top_mm = radius_mm - height_mm * std::tan(degrees * kDegree);
    const std::vector<glm::dvec2> outline{{0, -2.0},        {kRadius_mm, -2.0},  {kRadius_mm, 0.0},
                                          {radius_mm, 0.0}, {top_mm, height_mm}, {0, height_mm}};
    const auto at = [&](std::size_t n, int turn) {
      const double angle = 2.0 * std::numbers::pi * (turn % kAround) / kAround;
      return glm::vec3(
          coarse().frame.inP({outline[n].x * std::cos(angle), outline[n].x * std::sin(angle), outline[n].y}));
    };
    std::vector<std::array<glm::vec3, 3>> faces;
    for (int turn = 0; turn < kAround; ++turn)
      for (std::size_t n = 0; n + 1 < outline.size(); ++n) {
        if (outline[n].x > 0.0) faces.push_back({at(n, turn), at(n, turn + 1), at(n + 1, turn)});
        if (outline[n + 1].x > 0.0) faces.push_back({at(n, turn + 1), at(n + 1, turn + 1), at(n + 1, turn)});
      }
    if (!is_closed) faces.pop_back();
    std::string bytes(80, ' ');
    const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    put(static_cast<std::uint32_t>(faces.size()));
    for (const auto& face : faces) {
      put(glm::vec3(0.0F));
      for (const glm::vec3& p : face) put(p);
      put(std::uint16_t{0});
    }
    return bytes;
  }
  static std::string refusalOfFile(const std::string& path) {
    return tests::refusalOf<UsageError>([&] { readGivenIdeal(path, coarse().crown, "--ideal"); });
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("molar_ideal_" + std::to_string(::getpid()));
};

void expectAsByRule(const PreparationMeasure& given, double mm) {
  static const PreparationMeasure kByRule(coarse().crown, sharpCrown(), "--ideal");
  const BoxBytes made = coarse().made(stump(3.8, 8.0, 4.7));
  const PreparationOutcomes a = kByRule.outcomesOf(made), b = given.outcomesOf(made);
  EXPECT_NEAR(b.removed.over_mm3(), a.removed.over_mm3(), 0.02 * a.removed.over_mm3());
  EXPECT_NEAR(b.removed.wanted_mm3, a.removed.wanted_mm3, 0.005 * a.removed.wanted_mm3);
  EXPECT_NEAR(b.deviation.rms_mm, a.deviation.rms_mm, mm);
  ASSERT_TRUE(b.walls && b.margin && b.axis);
  EXPECT_NEAR(b.walls->convergence_rad / kDegree, 16.0, 0.3);
  EXPECT_NEAR(b.margin->mean_mm, 1.2, 0.02);
  EXPECT_EQ(given.rule().kind, IdealKind::crown);
  EXPECT_NEAR(given.rule().margin_mm, 1.0, 0.05);
  EXPECT_NEAR(given.rule().margin_height_mm, 0.0, 0.1);
  // The ideal itself is neither over nor under.
  const PreparationOutcomes ideal = given.outcomesOf(coarse().made(wanted()));
  EXPECT_LT(ideal.removed.over_mm3() + ideal.removed.under_mm3(), 0.03 * ideal.removed.wanted_mm3);
}

TEST(GivenIdeal, MeasuresAsTheRuleItWasMadeBy) {
  expectAsByRule(PreparationMeasure(coarse().crown, preparedBy(givenBy(wanted())), "--ideal"), 0.005);
}

TEST_F(GivenIdealFile, AVolumeMeasuresAsTheRuleItWasMadeBy) {
  for (const int full : {255, 1}) {
    const auto given = readGivenIdeal(write("ideal.nrrd", volume(wanted(), 0.1, full)), coarse().crown, "--ideal");
    EXPECT_EQ(given.digest.size(), 64u);
    expectAsByRule(PreparationMeasure(coarse().crown, preparedBy(given), "--ideal"), 0.03);
  }
}

TEST_F(GivenIdealFile, AMeshMeasuresAsTheRuleItWasMadeBy) {
  const auto given = readGivenIdeal(write("ideal.stl", mesh(4.0, 6.0, 5.0)), coarse().crown, "--ideal");
  expectAsByRule(PreparationMeasure(coarse().crown, preparedBy(given), "--ideal"), 0.01);
}

TEST(GivenIdeal, WhatGoesNotAllAroundHasNoWallsAndNoMargin) {
  // An onlay: no floor between two walls.
  const auto onlay = [](const glm::dvec3& p) { return std::min(intact_mm(p), std::max(-p.y, 5.0 - p.z)); };
  const PreparationMeasure measure(coarse().crown, preparedBy(givenBy(onlay)), "--ideal");
  EXPECT_EQ(measure.rule().kind, IdealKind::free);
  const PreparationOutcomes outcomes = measure.outcomesOf(coarse().made(intact_mm));
  EXPECT_FALSE(outcomes.walls || outcomes.margin || outcomes.cavity);
  EXPECT_NEAR(outcomes.removed.under_mm3(), outcomes.removed.wanted_mm3, 1e-6);
  EXPECT_NEAR(outcomes.removed.wanted_mm3, std::numbers::pi * kRadius_mm * kRadius_mm, 0.8);
}

// Where its groove lies is seen from the ideal itself: across the fissure, beside the axis, turned.
TEST(GivenIdeal, ACavityIsMeasuredAlongItsOwnGroove) {
  for (const double degrees : {0.0, 30.0, 90.0, -50.0}) {
    const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
    const auto groove = [&](double deeper_mm, double wider_mm) {
      return [=](const glm::dvec3& p) {
        const double along = c * (p.x - 0.6) + s * (p.y + 0.4), across = c * (p.y + 0.4) - s * (p.x - 0.6);
        const double inside_mm =
            std::min({2.0 - std::abs(along), 0.6 + 0.5 * wider_mm - std::abs(across), p.z - (5.0 - deeper_mm)});
        return std::min(intact_mm(p), -inside_mm);
      };
    };
    const PreparationMeasure measure(coarse().crown, preparedBy(givenBy(groove(0.0, 0.0))), "--ideal");
    ASSERT_EQ(measure.rule().kind, IdealKind::cavity) << degrees;
    EXPECT_EQ(measure.rule().box_side, 0);
    EXPECT_NEAR(measure.rule().depth_mm, 2.0, 0.03);
    EXPECT_NEAR(measure.rule().isthmus_mm, 1.2, 0.03);
    EXPECT_LT(glm::distance(measure.rule().groove_mm, {0.6, -0.4}), 0.05);
    const PreparationOutcomes outcomes = measure.outcomesOf(coarse().made(groove(0.4, 0.3)));
    ASSERT_TRUE(outcomes.cavity);
    EXPECT_NEAR(outcomes.cavity->depth_mm, 2.4, 0.03) << degrees;
    EXPECT_NEAR(outcomes.cavity->isthmus_mm, 1.5, 0.03) << degrees;
    EXPECT_NEAR(outcomes.cavity->length_mm, 4.0, 0.05) << degrees;
    EXPECT_NEAR(outcomes.cavity->divergence_rad, 0.0, 1.0 * kDegree);
    EXPECT_GT(outcomes.cavity->unsupported_mm2, 1.0);
  }
}

TEST(GivenIdeal, ACavityMeasuresAsTheRuleItWasMadeBy) {
  for (const char* const name : {"class-1", "class-2:mesial", "class-2:distal"}) {
    const IdealRule& rule = idealRule(name, "--ideal");
    const PreparationMeasure by_rule(coarse().crown, rule, "--ideal");
    const PreparationMeasure measure(
        coarse().crown, preparedBy(givenIdeal(by_rule.ideal(), coarse().crown, std::string(64, 'a'), "--ideal f")),
        "--ideal");
    ASSERT_EQ(measure.rule().kind, IdealKind::cavity) << name;
    EXPECT_EQ(measure.rule().box_side, rule.box_side) << name;
    const CavityForm a = *by_rule.outcomesOf(by_rule.ideal()).cavity, b = *measure.outcomesOf(by_rule.ideal()).cavity;
    EXPECT_NEAR(a.depth_mm, b.depth_mm, 0.03) << name;
    EXPECT_NEAR(a.isthmus_mm, b.isthmus_mm, 0.03) << name;
    if (rule.box_side == 0) continue;
    EXPECT_NEAR(a.box_axial_mm, b.box_axial_mm, 0.05) << name;
    EXPECT_NEAR(a.box_width_mm, b.box_width_mm, 0.05) << name;
    EXPECT_NEAR(a.box_height_mm, b.box_height_mm, 0.05) << name;
  }
}

TEST(GivenIdeal, RefusesWhatIsNoPreparationOfTheTooth) {
  EXPECT_THAT(refusalOf([](const glm::dvec3&) { return -1.0; }), HasSubstr("stands beside the tooth"));
  EXPECT_THAT(refusalOf([](const glm::dvec3& p) { return intact_mm(p + glm::dvec3(8.0, 0.0, 0.0)); }),
              HasSubstr("stands beside the tooth"));
  EXPECT_THAT(refusalOf([](const glm::dvec3& p) { return intact_mm(p - glm::dvec3(0.0, 0.0, 0.8)); }),
              HasSubstr("bigger than the tooth"));
  EXPECT_THAT(refusalOf(intact_mm), HasSubstr("as good as nothing"));
  // A skin between two ways of drawing the same tooth is none either.
  EXPECT_THAT(refusalOf([](const glm::dvec3& p) { return intact_mm(p) - 0.1; }), HasSubstr("as good as nothing"));
}

TEST_F(GivenIdealFile, RefusesInOneLine) {
  EXPECT_THAT(refusalOfFile(write("open.stl", mesh(4.0, 6.0, 5.0, false))), HasSubstr("not closed"));
  EXPECT_THAT(refusalOfFile(write("no.stl", "nothing")), HasSubstr("no STL file"));
  EXPECT_THAT(refusalOfFile(write("no.nrrd", "nothing")), HasSubstr("no.nrrd"));
  EXPECT_THAT(refusalOfFile(write("empty.nrrd", volume([](const glm::dvec3&) { return -1.0; }, 0.25, 255))),
              HasSubstr("beside the tooth"));
  EXPECT_THAT(refusalOfFile("/nowhere/ideal.nrrd"), HasSubstr("--ideal /nowhere/ideal.nrrd"));
}

TEST(GivenIdeal, OfAnotherToothIsRefused) {
  assets::GivenIdeal other = givenBy(wanted());
  other.grid.origin_P_mm.x += 1.0;
  EXPECT_THROW(PreparationMeasure(coarse().crown, preparedBy(other), "--ideal"), UsageError);
}

}  // namespace
}  // namespace app::round_tooth
