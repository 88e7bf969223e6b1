#include "assets/segment/thick_parts.h"

#include <gtest/gtest.h>

#include "assets/scan/exact_distance.h"
#include "assets/segment/region_graph.h"

namespace {

constexpr glm::ivec3 kBox{60, 26, 26};

/// Two balls of radius 10 in a row, `apart` cells between their centres.
struct Balls {
  explicit Balls(double apart) : mask(assets::countIn(kBox), 0) {
    assets::CellMask outside(mask.size());
    assets::forCells(kBox, [&](glm::ivec3 p, std::size_t n) {
      const glm::dvec3 a(glm::dvec3(p) - glm::dvec3(29.5 - 0.5 * apart, 12.5, 12.5));
      const glm::dvec3 b(glm::dvec3(p) - glm::dvec3(29.5 + 0.5 * apart, 12.5, 12.5));
      mask[n] = glm::dot(a, a) < 100.0 || glm::dot(b, b) < 100.0 ? 1 : 0;
      outside[n] = mask[n] == 0 ? 1 : 0;
    });
    thickness = assets::exactDistance_mm(kBox, 1.0, outside);
  }
  assets::CellMask mask;
  std::vector<float> thickness;
};

TEST(ThickParts, TwoBallsAreTwoPartsThatMeetHalfway) {
  const Balls balls(15.0);
  const assets::CellPieces parts = assets::thickParts(kBox, balls.thickness, balls.mask, 0.5);
  ASSERT_EQ(parts.cells.size(), 3u);
  EXPECT_NEAR(static_cast<double>(parts.cells[1]), static_cast<double>(parts.cells[2]), 60.0);
  assets::forCells(kBox, [&](glm::ivec3 p, std::size_t n) {
    if (balls.mask[n] != 0) {
      EXPECT_EQ(parts.of[n] == parts.of[assets::indexIn(kBox, {20, 12, 12})], p.x < 30);
    }
    EXPECT_EQ(parts.of[n] == 0, balls.mask[n] == 0);
  });
  const auto necks = assets::necksBetween(kBox, balls.thickness, parts.of);
  ASSERT_EQ(necks.size(), 1u);
  EXPECT_NEAR(necks.at({1, 2}), std::sqrt(100.0 - 7.5 * 7.5), 0.8) << "the radius where the balls meet";
}

TEST(ThickParts, AShallowNeckDividesNothing) {
  const Balls balls(15.0);
  EXPECT_EQ(assets::thickParts(kBox, balls.thickness, balls.mask, 5.0).cells.size(), 2u);
  const Balls one(0.0);
  EXPECT_EQ(assets::thickParts(kBox, one.thickness, one.mask, 0.5).cells.size(), 2u);
}

TEST(RegionGraph, JoinsARootToItsCrownAndNoTwoTeeth) {
  using assets::RegionPart;
  // Two teeth with a thick contact, a root without enamel below the second, a crumb at the first.
  const std::vector<RegionPart> parts = {
      {}, {4.0, 900.0, 200.0}, {4.0, 500.0, 150.0}, {3.0, 300.0, 1.0}, {1.5, 40.0, 10.0}};
  const assets::RegionNecks necks = {{{1, 2}, 3.2F}, {{2, 3}, 2.2F}, {{1, 4}, 1.2F}};
  EXPECT_EQ(assets::joinedParts(parts, necks), (std::vector<std::int32_t>{0, 1, 2, 2, 1}));
}

}  // namespace
