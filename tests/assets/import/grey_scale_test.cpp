#include "assets/import/grey_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "assets/import/shading.h"
#include "assets/import/soft_tissue_removal.h"

namespace {

using assets::GreyScale;

constexpr std::int16_t kNone = -32768;

/// A head's tissues in Hounsfield with noise, mapped to grey = (HU - offset) / slope.
std::vector<std::int16_t> head(double slope, double offset_hu, std::optional<std::int16_t> fill = std::nullopt) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 60.0);
  std::vector<std::int16_t> grey;
  const auto add = [&](int count, double hu) {
    for (int n = 0; n < count; ++n)
      grey.push_back(static_cast<std::int16_t>(std::lround((hu + noise(random) - offset_hu) / slope)));
  };
  add(40'000, -1000), add(50'000, 40), add(12'000, 450), add(9'000, 1250), add(4'000, 1650), add(1'500, 2500);
  if (fill) grey.insert(grey.end(), 15'000, *fill);
  return grey;
}

TEST(GreyScale, TakesHounsfieldAsTheyStand) {
  const auto judged = assets::judgeGreyScale(head(1, 0, std::int16_t{-1024}), kNone);
  ASSERT_TRUE(judged.map);
  EXPECT_EQ(judged.map->scale, GreyScale::hounsfield);
  EXPECT_EQ(judged.map->slope, 1.0);
  EXPECT_EQ(judged.map->offset_hu, 0.0);
}

TEST(GreyScale, SeesHounsfieldThatAreStoredHigher) {
  const auto judged = assets::judgeGreyScale(head(1, -1024, std::int16_t{0}), kNone);
  ASSERT_TRUE(judged.map);
  EXPECT_EQ(judged.map->scale, GreyScale::shifted);
  EXPECT_EQ(judged.map->slope, 1.0);
  EXPECT_NEAR(judged.map->offset_hu, -1024.0, 24.0);
}

TEST(GreyScale, FindsTheLineThroughAirAndSoftTissue) {
  for (const double slope : {0.6, 0.8, 1.3, 1.6})
    for (const double offset_hu : {-2500.0, -600.0, 300.0}) {
      const auto judged = assets::judgeGreyScale(head(slope, offset_hu), kNone);
      ASSERT_TRUE(judged.map) << slope << ' ' << offset_hu;
      const auto& map = *judged.map;
      if (map.scale != GreyScale::two_points) continue;  // near Hounsfield by chance
      EXPECT_NEAR(map.slope, slope, 0.08 * slope);
      EXPECT_NEAR(map.slope * (40.0 - offset_hu) / slope + map.offset_hu, 40.0, 40.0);
      EXPECT_NEAR(map.slope * (1650.0 - offset_hu) / slope + map.offset_hu, 1650.0, 0.08 * 1650.0);
    }
}

TEST(GreyScale, HasNoScaleForOnePeak) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(13.0, 4.0);
  std::vector<std::int16_t> grey(50'000);
  for (auto& value : grey) value = static_cast<std::int16_t>(std::lround(noise(random)));
  const auto judged = assets::judgeGreyScale(grey, kNone);
  EXPECT_FALSE(judged.map);
  ASSERT_EQ(judged.peaks.size(), 1U);
  EXPECT_NEAR(judged.peaks[0].grey, 13.0, 2.0);
  EXPECT_FALSE(assets::judgeGreyScale({}, kNone).map);
  EXPECT_FALSE(assets::judgeGreyScale(std::vector<std::int16_t>(1000, 7), kNone).map);
  EXPECT_TRUE(assets::judgeGreyScale(std::vector<std::int16_t>(1000, -1000), kNone).map);
}

TEST(GreyScale, TakesThreeTissuesFromTheOwner) {
  const auto map = assets::greyMapFromTissues({100, 625, 1425});  // grey = (HU + 1200) / 2
  ASSERT_TRUE(map);
  EXPECT_NEAR(map->slope, 2.0, 1e-9);
  EXPECT_NEAR(map->offset_hu, -1200.0, 1e-6);
  EXPECT_FALSE(assets::greyMapFromTissues({100, 100, 1425}));
  std::vector<std::int16_t> grey = {100, kNone, 32000};
  assets::applyGreyMap(*map, kNone, grey);
  EXPECT_EQ(grey, (std::vector<std::int16_t>{-1000, kNone, 32767}));
}

TEST(Shading, IsTakenOffSoftTissueAndWhatLiesInIt) {
  const assets::VolumeGrid grid{{60, 60, 60}, 1.4, {0, 0, 0}};
  std::vector<std::int16_t> hounsfield(grid.voxelCount());
  const auto is_bone = [](glm::ivec3 ijk) { return glm::length(glm::dvec3(ijk) - 30.0) < 6.0; };
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double cupping = 120.0 * std::cos(0.05 * (ijk.x - 30));
    hounsfield[v] = static_cast<std::int16_t>((is_bone(ijk) ? 1200.0 : 40.0) + cupping);
  });
  EXPECT_GT(assets::flattenShading(grid, hounsfield), 12.0);
  const auto at = [&](glm::ivec3 ijk) { return hounsfield[grid.index(ijk)]; };
  for (const int x : {8, 20, 40, 52}) EXPECT_NEAR(at({x, 10, 12}), 20, 35) << x;
  EXPECT_NEAR(at({30, 30, 30}), 1180, 60);
  std::vector<std::int16_t> all_bone(grid.voxelCount(), 1300);
  EXPECT_EQ(assets::flattenShading(grid, all_bone), 0.0);
  EXPECT_EQ(all_bone[5], 1300);
}

// A ball of bone in a block of soft tissue, and a bright speck far away.
TEST(SoftTissueRemoval, LeavesNothingFartherThanTwelveMillimetresFromBone) {
  const assets::VolumeGrid grid{{90, 90, 90}, 0.7, {0, 0, 0}};
  std::vector<std::int16_t> hounsfield(grid.voxelCount(), 40);
  const auto is_bone = [](glm::ivec3 ijk) { return glm::length(glm::dvec3(ijk) - 30.0) < 12.0; };
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (is_bone(ijk)) hounsfield[v] = 1200;
  });
  hounsfield[grid.index({80, 80, 80})] = 3000;
  const double removed_mm3 = assets::removeDistantSoftTissue(grid, hounsfield, 300.0);
  double gone_mm3 = 0.0;
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double from_bone_mm = 0.7 * (glm::length(glm::dvec3(ijk) - 30.0) - 12.0);
    if (from_bone_mm > 12.5) {
      ASSERT_EQ(hounsfield[v], -1000) << from_bone_mm;
    }
    if (from_bone_mm < 8.0) {
      ASSERT_EQ(hounsfield[v], is_bone(ijk) ? 1200 : 40) << from_bone_mm;
    }
    gone_mm3 += hounsfield[v] == -1000 ? grid.voxelVolume_mm3() : 0.0;
  });
  EXPECT_NEAR(removed_mm3, gone_mm3, 1.0e-6 * gone_mm3);
}

}  // namespace
