// The apex locator against its published accuracy, and its perforation.
#include "app/procedure/root_canal/apex_locator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/tissue.h"

namespace app {
namespace {

using Place = LocatorReading::Place;

/// A round root of 1.5 mm about a straight canal, 12 mm down to its foramen; around it ligament and bone.
struct Root {
  assets::ToothCanals tooth;
  assets::CtVolume scan;

  Root() {
    assets::ToothCanal canal;
    canal.name = "distal";
    for (int n = 0; n <= 12; ++n) canal.places.push_back({{0.0, 0.0, -2.0 - n}, 1.0 * n, 0.2, 0.2});
    canal.constriction_mm = 11.5;
    tooth.canals.push_back(canal);
    tooth.chamber.floor_mm = -2.0;
    scan.grid = {{40, 40, 160}, 0.1, {-2.0, -2.0, -15.0}};
    scan.label.resize(scan.grid.voxelCount());
    assets::forVoxels(scan.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = scan.grid.centre_P_mm(ijk);
      const double r = std::hypot(p.x, p.y);
      const auto tissue = r < 0.2                  ? assets::Tissue::pulp
                          : r < 1.5 && p.z > -14.2 ? assets::Tissue::dentine
                                                   : assets::Tissue::ligament;
      scan.label[v] = static_cast<std::uint8_t>(tissue);
    });
  }
  glm::dvec3 at(double from_foramen_mm) const { return {0.0, 0.0, -14.0 + from_foramen_mm}; }
};

TEST(ApexLocator, TellsTheWayToTheForamenExactlyWhereItIsAskedTo) {
  const Root root;
  const ApexLocator locator(root.tooth, root.scan, ApexLocator::Mode::exact, 1);
  for (const double left_mm : {0.0, 0.5, 1.0, 2.9}) {
    const auto reading = locator.at(root.at(left_mm), 3.0, true);
    ASSERT_TRUE(reading);
    EXPECT_NEAR(reading->left_mm, left_mm, 1e-9);
    EXPECT_EQ(reading->place, Place::canal);
  }
  EXPECT_EQ(locator.at(root.at(9.0), 0.0, false)->left_mm, LocatorReading::kMost_mm);
  EXPECT_TRUE(locator.at(root.at(0.0), 0.0, false)->isApex());
  const auto beyond = locator.at(root.at(-0.3), 0.0, false);
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->place, Place::beyond);
  EXPECT_TRUE(beyond->isApex());
  EXPECT_FALSE(locator.at({0.0, 0.0, 1.0}, 0.0, false)) << "over the tooth: an open circuit";
  EXPECT_FALSE(locator.at({1.2, 0.0, -6.0}, 0.0, false)) << "in the dentine";
}

TEST(ApexLocator, SaysApexAtOnceInAPerforation) {
  const Root root;
  const ApexLocator locator(root.tooth, root.scan, ApexLocator::Mode::real, 1);
  // From the canal through the wall, 8 mm short of the foramen.
  double opened_mm = 0.0;
  for (double r = 0.0; r < 2.0; r += 0.05)
    if (const auto reading = locator.at({r, 0.0, -6.0}, 0.0, false); reading && reading->isApex()) {
      EXPECT_EQ(reading->place, Place::perforation);
      opened_mm = opened_mm > 0.0 ? opened_mm : r;
    } else {
      EXPECT_EQ(opened_mm, 0.0);
    }
  EXPECT_NEAR(opened_mm, 1.5, 0.11);
}

// Welk 2004: 0.19 mm long in the mean, 90.7 % within half a millimetre.
TEST(ApexLocator, ErrsAsOftenAsPublished) {
  const Root root;
  double sum_mm = 0.0;
  int within = 0;
  constexpr int kSeeds = 1000;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const ApexLocator locator(root.tooth, root.scan, ApexLocator::Mode::real, static_cast<std::uint64_t>(seed));
    const double error_mm = locator.at(root.at(1.5), 0.0, false)->left_mm - 1.5;
    sum_mm += error_mm;
    within += std::abs(error_mm) <= 0.5;
  }
  EXPECT_NEAR(sum_mm / kSeeds, 0.19, 0.03);
  EXPECT_NEAR(within / 1000.0, 0.907, 0.03);
}

TEST(ApexLocator, SaysTheSameAgainAndJumpsWhereTheCanalIsDry) {
  const Root root;
  const ApexLocator locator(root.tooth, root.scan, ApexLocator::Mode::real, 7), again = locator;
  double least[2]{9.0, 9.0}, most[2]{0.0, 0.0};
  for (int n = 0; n < 400; ++n)
    for (const bool is_dry : {false, true}) {
      const double t_s = 0.05 * n, left_mm = locator.at(root.at(1.6), t_s, is_dry)->left_mm;
      EXPECT_EQ(left_mm, again.at(root.at(1.6), t_s, is_dry)->left_mm);
      least[is_dry] = std::min(least[is_dry], left_mm), most[is_dry] = std::max(most[is_dry], left_mm);
    }
  EXPECT_LT(most[0] - least[0], 0.2) << "flickers";
  EXPECT_GT(most[1] - least[1], 1.0) << "jumps";
}

}  // namespace
}  // namespace app
