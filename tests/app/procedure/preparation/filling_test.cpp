// Measures of fillings in a round tooth, against their formulae.
#include "app/procedure/preparation/filling_outcomes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/procedure/preparation/preparation_watch.h"
#include "haptics/bone/lay.h"
#include "tests/app/procedure/preparation/round_tooth.h"

namespace app {
namespace {

using assets::Tissue;
using round_tooth::Scene;

constexpr double kRadius_mm = 1.0;

/// The tooth with a cylinder, D 2 mm, cut from the top to this height.
shapes::Depth drilled(double floor_mm) {
  return [=](const glm::dvec3& p) {
    return std::min(round_tooth::intact_mm(p), std::max(std::hypot(p.x, p.y) - kRadius_mm, floor_mm - p.z));
  };
}

struct Filled {
  Scene scene;
  BoxBytes made;
  LaidBoxes laid;

  explicit Filled(double floor_mm = 5.0, bool is_askew = false)
      : scene(0.08, is_askew),
        made(scene.made(drilled(floor_mm))),
        laid{BoxBytes(made.grid()), BoxBytes(made.grid()), BoxBytes(made.grid())} {}

  /// Into air, as much of each voxel as lies within a depth of the tooth's frame.
  void lay(const shapes::Depth& shape, Tissue tissue = Tissue::composite, int increment = 1) {
    const BoxBytes of = scene.made(shape);
    for (std::size_t v = 0; v < of.bytes().size(); ++v) {
      const int room = 255 - made.bytes()[v] - laid.laid.bytes()[v];
      const int more = std::min<int>(room, of.bytes()[v]);
      if (more <= 0) continue;
      laid.laid.bytes()[v] = static_cast<std::uint8_t>(laid.laid.bytes()[v] + more);
      laid.tissue.bytes()[v] = static_cast<std::uint8_t>(tissue);
      laid.increment.bytes()[v] = static_cast<std::uint8_t>(increment);
    }
  }
  FillingOutcomes outcomes() { return FillingMeasure(scene.crown).outcomesOf(made, laid); }
};

/// Between two heights, within a radius of the axis.
shapes::Depth disc(double low_mm, double high_mm, double radius_mm = kRadius_mm + 0.04) {
  return [=](const glm::dvec3& p) { return std::min({radius_mm - std::hypot(p.x, p.y), p.z - low_mm, high_mm - p.z}); };
}

TEST(FillingOutcomes, OfACylinderAreItsVolume) {
  for (const bool is_askew : {false, true}) {
    Filled filled(5.0, is_askew);
    filled.lay(disc(4.9, 7.0));
    const FillingOutcomes of = filled.outcomes();
    EXPECT_NEAR(of.laid_mm3, 6.283, 0.01 * 6.283);
    EXPECT_NEAR(of.cavity_mm3, 6.283, 0.01 * 6.283);
    EXPECT_NEAR(of.filledShare(), 1.0, 0.01);
    EXPECT_EQ(of.curedShare(), 1.0);
    EXPECT_TRUE(of.voids.empty());
    EXPECT_NEAR(of.overhang_mm3, 0.0, 0.005);
    EXPECT_NEAR(of.contour_mm2, std::numbers::pi, 0.1 * std::numbers::pi);
    EXPECT_LT(of.contour_rms_mm, 0.02);
    ASSERT_EQ(of.increments.size(), 1U);
    EXPECT_NEAR(of.increments[0].depth_mm, 2.0, 0.12);
  }
}

TEST(FillingOutcomes, FindAVoidOfItsSize) {
  Filled filled;
  const auto ball = [](const glm::dvec3& p) { return 0.3 - glm::distance(p, glm::dvec3(0.1, 0.0, 6.0)); };
  filled.lay([&](const glm::dvec3& p) { return std::min(disc(4.9, 7.0)(p), -ball(p)); });
  const FillingOutcomes of = filled.outcomes();
  EXPECT_NEAR(of.laid_mm3, 6.283 - 0.113, 0.01 * 6.283);
  ASSERT_EQ(of.voids.size(), 1U);
  EXPECT_NEAR(of.voids[0].volume_mm3, 0.113, 0.03 * 0.113);
  EXPECT_NEAR(glm::distance(filled.scene.frame.local(of.voids[0].middle_P_mm), glm::dvec3(0.1, 0.0, 6.0)), 0.0, 0.02);
  // Open to the outside it is none.
  Filled open;
  open.lay([&](const glm::dvec3& p) { return std::min(disc(4.9, 7.0)(p), std::hypot(p.x, p.y) - 0.3); });
  EXPECT_TRUE(open.outcomes().voids.empty());
}

TEST(FillingOutcomes, TellOverhangAndWhatIsTooHighOrLow) {
  Filled high;
  high.lay(disc(4.9, 7.3, 1.5));
  const FillingOutcomes over = high.outcomes();
  // A disc of 1.5 mm radius stands 0.3 mm over the tooth, of which 0.2 count.
  EXPECT_NEAR(over.overhang_mm3, std::numbers::pi * 2.25 * 0.2, 0.25);
  EXPECT_NEAR(over.overhang_mm, 0.3, 0.05);
  EXPECT_NEAR(over.too_high_mm, 0.3, 0.03);
  EXPECT_NEAR(over.filledShare(), 1.0, 0.01);
  Filled low;
  low.lay(disc(4.9, 6.7));
  const FillingOutcomes under = low.outcomes();
  EXPECT_NEAR(under.filledShare(), 0.85, 0.01);
  EXPECT_NEAR(under.too_low_mm, 0.3, 0.03);
  EXPECT_NEAR(under.contour_mean_mm, -0.3, 0.03);
  EXPECT_EQ(under.overhang_mm3, 0.0);
}

TEST(FillingOutcomes, TellIncrementsOverTwoMillimetresAndWhatIsCured) {
  Filled filled(4.0);
  filled.lay(disc(3.9, 6.4), Tissue::composite, 1);
  filled.lay(disc(6.4, 7.0), Tissue::composite_soft, 2);
  const FillingOutcomes of = filled.outcomes();
  ASSERT_EQ(of.increments.size(), 2U);
  EXPECT_NEAR(of.increments[0].depth_mm, 2.4, 0.12);
  EXPECT_NEAR(of.increments[1].depth_mm, 0.6, 0.12);
  EXPECT_TRUE(of.increments[0].isTooDeep());
  EXPECT_FALSE(of.increments[1].isTooDeep());
  EXPECT_NEAR(of.curedShare(), 2.4 / 3.0, 0.02);
  EXPECT_NE(fillingLine(of).find("increment 1 is 2.4 mm deep, over 2"), std::string::npos) << fillingLine(of);
  // Amalgam is packed in portions as deep as one likes.
  Filled packed(4.0);
  packed.lay(disc(3.9, 7.0), Tissue::amalgam, 1);
  EXPECT_FALSE(packed.outcomes().increments[0].isTooDeep());
  EXPECT_EQ(packed.outcomes().curable_mm3, 0.0);
}

TEST(FillingOutcomes, AreMeasuredOfTheBytesThatARecordingKeeps) {
  assets::CtVolume ct;
  ct.grid = {glm::ivec3(40, 36, 44), 0.08, {-1.6, -1.4, -1.8}};
  ct.solid.assign(ct.grid.voxelCount(), 0);
  ct.label.assign(ct.grid.voxelCount(), static_cast<std::uint8_t>(Tissue::dentine));
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) { ct.solid[v] = ijk.z < 9 ? 255 : 0; });
  haptics::Bodies bodies(ct.grid, ct.solid, ct.label);
  ToothCopy copy(ct, ct.solid);
  const auto follow = [&] {
    std::vector<glm::ivec3> bricks;
    bodies.takeDirtyBricks(bricks);
    copy.take(bodies, bricks);
  };
  follow();
  EXPECT_TRUE(copy.filling().laid.empty());
  for (unsigned n = 0; n < 3; ++n) {
    const calibration::Point<calibration::Patient> at{{0.4 * n - 0.4, 0.1, -0.9 + 0.3 * n}};
    haptics::layBall({bodies.jaw().field(), *bodies.filling(), at, 0.5}, Tissue::amalgam, n + 1, 1'000'000'000);
    follow();
  }
  const haptics::Filling::Volumes kept = bodies.filling()->volumes();
  // The copy's grid is of whole blocks, as this one is.
  EXPECT_EQ(copy.filling().laid, kept.laid);
  EXPECT_EQ(copy.filling().tissue, kept.tissue);
  EXPECT_EQ(copy.filling().increment, kept.increment);
  EXPECT_EQ(*std::ranges::max_element(kept.increment), 3);
}

TEST(FillingOutcomes, OfNothingAreNone) {
  Filled filled;
  const FillingOutcomes of = filled.outcomes();
  EXPECT_EQ(of.laid_mm3, 0.0);
  EXPECT_NEAR(of.cavity_mm3, 6.283, 0.01 * 6.283);
  EXPECT_TRUE(of.increments.empty());
}

}  // namespace
}  // namespace app
