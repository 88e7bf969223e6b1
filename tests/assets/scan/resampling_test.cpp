#include "assets/scan/resampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "assets/load_error.h"

namespace {

using assets::Resampling;
using assets::ScanGeometry;

// HU that is a plane in P, sampled on the scan's voxels.
const glm::dvec3 kSlope_HU_per_mm(40.0, -30.0, 25.0);

std::vector<std::int16_t> planeOn(const ScanGeometry& scan) {
  std::vector<std::int16_t> values;
  for (int k = 0; k < scan.size.z; ++k)
    for (int j = 0; j < scan.size.y; ++j)
      for (int i = 0; i < scan.size.x; ++i)
        values.push_back(static_cast<std::int16_t>(
            std::lround(glm::dot(kSlope_HU_per_mm, scan.origin_P_mm + scan.step_P_mm * glm::dvec3(i, j, k)))));
  return values;
}

glm::dmat3 rotation(std::mt19937& random) {
  std::normal_distribution<double> component;
  const glm::dvec3 x = glm::normalize(glm::dvec3(component(random), component(random), component(random)));
  const glm::dvec3 y =
      glm::normalize(glm::cross(x, glm::dvec3(component(random), component(random), component(random))));
  return {x, y, glm::cross(x, y)};
}

TEST(Resampling, CopiesEveryAxisOrderAndFlipExactly) {
  const glm::ivec3 orders[] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (const auto& order : orders)
    for (int flips = 0; flips < 8; ++flips) {
      ScanGeometry scan{{5, 4, 3}, glm::dmat3(0.0), {10, 20, 30}};
      for (int a = 0; a < 3; ++a) scan.step_P_mm[a][order[a]] = (flips >> a & 1) != 0 ? -0.4 : 0.4;
      const Resampling resampling(scan, "scan");
      ASSERT_TRUE(resampling.isExact());
      const auto values = resampling.linear(planeOn(scan), std::int16_t{-1000});
      ASSERT_EQ(values.size(), 60u);
      for (int k = 0; k < resampling.grid().size.z; ++k)
        for (int j = 0; j < resampling.grid().size.y; ++j)
          for (int i = 0; i < resampling.grid().size.x; ++i)
            EXPECT_EQ(values[resampling.grid().index({i, j, k})],
                      std::lround(glm::dot(kSlope_HU_per_mm, resampling.grid().centre_P_mm({i, j, k}))));
    }
}

TEST(Resampling, ToleratesFloatRounding) {
  ScanGeometry scan{{300, 300, 2}, glm::dmat3(0.4), {0, 0, 0}};
  scan.step_P_mm[0] = {0.4000000059604645, 1e-8, -2e-8};
  EXPECT_TRUE(Resampling(scan, "scan").isExact());
  scan.step_P_mm[0] = {0.4, 1e-4, 0};  // 0.075 voxel over the extent
  EXPECT_FALSE(Resampling(scan, "scan").isExact());
}

TEST(Resampling, UsesTheSmallestSpacingAndKeepsThePosition) {
  ScanGeometry scan{{4, 3, 5}, glm::dmat3(1.0), {1, 2, 3}};
  scan.step_P_mm[0].x = 0.25;
  scan.step_P_mm[1].y = 0.5;
  const Resampling resampling(scan, "scan");
  EXPECT_EQ(resampling.grid().size, glm::ivec3(4, 6, 20));
  EXPECT_DOUBLE_EQ(resampling.grid().spacing_mm, 0.25);
  EXPECT_EQ(resampling.grid().origin_P_mm, glm::dvec3(1.0, 1.875, 2.625));
}

TEST(Resampling, InterpolatesALinearFieldExactlyAtAnyAngle) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 8; ++trial) {
    const glm::dmat3 axes = rotation(random);
    const ScanGeometry scan{{12, 14, 9}, {0.4 * axes[0], 0.4 * axes[1], 0.7 * axes[2]}, {5, -7, 9}};
    const Resampling resampling(scan, "scan");
    EXPECT_FALSE(resampling.isExact());
    const auto values = resampling.linear(planeOn(scan), std::int16_t{-1000});
    const glm::dmat3 index_per_mm = glm::inverse(scan.step_P_mm);
    int inside = 0;
    for (int k = 0; k < resampling.grid().size.z; ++k)
      for (int j = 0; j < resampling.grid().size.y; ++j)
        for (int i = 0; i < resampling.grid().size.x; ++i) {
          const glm::dvec3 p_P_mm = resampling.grid().centre_P_mm({i, j, k});
          const glm::dvec3 index = index_per_mm * (p_P_mm - scan.origin_P_mm);
          const glm::dvec3 past = glm::max(-index, index - glm::dvec3(scan.size - 1));
          const double farthest = std::max({past.x, past.y, past.z});
          const auto value = values[resampling.grid().index({i, j, k})];
          if (farthest > 0.51) {
            EXPECT_EQ(value, -1000);
          }
          if (farthest > 0.0) continue;
          ++inside;
          EXPECT_NEAR(value, glm::dot(kSlope_HU_per_mm, p_P_mm), 1.01);  // both roundings
        }
    EXPECT_GT(inside, 12 * 14 * 9);
  }
}

TEST(Resampling, TakesLabelsOfTheNearestVoxel) {
  ScanGeometry scan{{2, 1, 1}, glm::dmat3(1.0), {0, 0, 0}};
  scan.step_P_mm[1].y = 0.25;
  scan.step_P_mm[2].z = 0.25;
  const auto labels = Resampling(scan, "scan").nearest({3, 9}, 0);
  EXPECT_EQ(labels, (std::vector<std::uint8_t>{3, 3, 3, 3, 9, 9, 9, 9}));
}

TEST(Resampling, RefusesInvalidGeometry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusalOf = [](const ScanGeometry& scan) -> std::string {
    try {
      Resampling{scan, "scan"};
    } catch (const assets::LoadError& error) {
      return error.what();
    }
    return "accepted";
  };
  const ScanGeometry good{{4, 4, 4}, glm::dmat3(0.4), {0, 0, 0}};
  EXPECT_EQ(refusalOf(good), "accepted");
  auto bad = good;
  bad.size.y = 0;
  EXPECT_THAT(refusalOf(bad), testing::HasSubstr("no voxels"));
  bad = good;
  bad.size = {2000, 2000, 2000};
  EXPECT_THAT(refusalOf(bad), testing::HasSubstr("at most 1073741824 voxels"));
  bad = good;
  bad.step_P_mm[2] = {0.4, 0.001, 0.0};
  EXPECT_THAT(refusalOf(bad), testing::HasSubstr("singular"));
  bad = good;
  bad.step_P_mm[1].z = nan;
  EXPECT_THAT(refusalOf(bad), testing::HasSubstr("finite"));
  bad = good;
  bad.origin_P_mm.x = nan;
  EXPECT_THAT(refusalOf(bad), testing::HasSubstr("finite"));
  bad = good;
  bad.step_P_mm[0] = {0, 0, 0};
  EXPECT_THAT(refusalOf(bad), testing::HasSubstr("is outside 0.001 to 50 mm"));
  bad = good;
  bad.size = {1000, 1000, 1000};
  bad.step_P_mm[2].z = 40.0;  // a thousandth of a slice apart
  EXPECT_THAT(refusalOf(bad), testing::HasSubstr("as cubic voxels"));
}

}  // namespace
