#include "app/session/measures/hand_work.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "app/session/measures/original_surface.h"
#include "tests/app/session/measures/bur_path.h"

namespace app {
namespace {

double valueOf(const HandWork& work, std::string_view id) {
  for (const MeasureValue& value : work.values())
    if (value.id == id) return value.value.value_or(std::nan(""));
  ADD_FAILURE() << id;
  return std::nan("");
}

TEST(HandWork, TimesOfAScriptedLog) {
  // 1 s off; 2 s on in air; 3 s in bone, the last of them dry; 0.2 s in air; 1 s in bone.
  HandWork work;
  double t_s = 0.0;
  const auto go = [&](double seconds, bool turns, bool touches, bool water) {
    for (int n = 0; n < std::lround(seconds * 1e3); ++n, t_s += 1e-3) {
      WorkSample sample = bur_path::sampleAt(t_s, {0.0, 0.0, 0.0});
      sample.turns = turns;
      sample.touches = touches;
      sample.irrigated = water;
      work.add(sample);
    }
  };
  go(1.0, false, false, true);
  go(2.0, true, false, true);
  go(2.0, true, true, true);
  go(1.0, true, true, false);
  go(0.2, true, false, true);
  go(1.0, true, true, true);
  EXPECT_NEAR(valueOf(work, "M1.total"), 7.2, 1e-9);
  EXPECT_NEAR(valueOf(work, "M1.on"), 6.2, 1e-9);
  EXPECT_NEAR(valueOf(work, "M1.contact"), 4.0, 1e-9);
  EXPECT_NEAR(valueOf(work, "M1.drilling"), 4.0, 1e-9);
  EXPECT_NEAR(valueOf(work, "M1.idle"), 2.0, 2e-3) << "the short rest is none";
  EXPECT_NEAR(valueOf(work, "M1.on_ratio"), 6.2 / 7.2, 1e-9);
  EXPECT_NEAR(valueOf(work, "S10.dry"), 1.0, 1e-9);
}

TEST(HandWork, TheWayOfACircleIsItsLength) {
  HandWork work;
  for (int n = 0; n <= 4000; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / 4000;
    WorkSample sample = bur_path::sampleAt(n * 1e-3, {5.0 * std::cos(angle), 5.0 * std::sin(angle), 0.0});
    sample.touches = n > 2000;
    work.add(sample);
  }
  EXPECT_NEAR(valueOf(work, "M2.path"), 31.42, 0.01);
  EXPECT_NEAR(valueOf(work, "M2.contact"), 15.71, 0.01);
  EXPECT_NEAR(valueOf(work, "M2.free"), 15.71, 0.01);
}

TEST(HandWork, AnInvalidTickIsNoWay) {
  HandWork work;
  work.add(bur_path::sampleAt(0.0, {0.0, 0.0, 0.0}));
  WorkSample lost = bur_path::sampleAt(1e-3, glm::dvec3(std::nan("")));
  lost.valid = false;
  work.add(lost);
  work.add(bur_path::sampleAt(2e-3, {100.0, 0.0, 0.0}));
  work.add(bur_path::sampleAt(3e-3, {101.0, 0.0, 0.0}));
  EXPECT_EQ(valueOf(work, "M2.path"), 1.0);
}

TEST(HandWork, VolumeForTimeAndWay) {
  HandWork work;
  for (const WorkSample& sample : bur_path::raster(6, 0.2)) work.add(sample);
  work.finish();
  const double per_mm = 0.5 * bur_path::kRadius_mm * 0.2;
  EXPECT_NEAR(valueOf(work, "M3.per_way"), per_mm, 0.01 * per_mm);
  EXPECT_NEAR(valueOf(work, "M3.rate"), per_mm * 30.0, 0.01 * per_mm * 30.0);
  EXPECT_GE(valueOf(work, "PI"), 0.9);
  EXPECT_NEAR(valueOf(work, "M7.speed"), 30.0, 0.5);
  EXPECT_NEAR(valueOf(work, "M7.force"), 2.0, 1e-9);
  EXPECT_NEAR(valueOf(work, "M8.angle"), 90.0, 1e-6);
  EXPECT_EQ(valueOf(work, "M8.steep"), 1.0);
}

TEST(HandWork, TheAngleIsThatOfTheAxisToTheSurface) {
  HandWork work;
  for (WorkSample sample : bur_path::raster(2, 0.2)) {
    sample.axis_P = {std::cos(0.5), 0.0, std::sin(0.5)};
    work.add(sample);
  }
  EXPECT_NEAR(valueOf(work, "M8.angle"), 0.5 * 180.0 / std::numbers::pi, 1e-6);
  EXPECT_EQ(valueOf(work, "M8.steep"), 0.0);
}

TEST(HandWork, IdsAreUniqueAndWhatIsMissingSaysWhy) {
  const HandWork work;
  std::set<std::string_view> ids;
  for (const MeasureValue& value : work.values()) {
    EXPECT_TRUE(ids.insert(value.id).second) << value.id;
    EXPECT_TRUE(value.value || !value.why.empty()) << value.id;
  }
  EXPECT_GT(ids.size(), 20U);
}

// On a jaw's voxels, and on a fine field's, which are taken together.
TEST(HandWork, OutOfABallOfBoneIsAwayFromItsCentre) {
  for (const double spacing_mm : {0.3, 0.09}) {
    const int count = static_cast<int>(18.0 / spacing_mm);
    const double first_mm = -0.5 * (count - 1) * spacing_mm;
    const assets::VolumeGrid grid{
        .size = glm::ivec3(count), .spacing_mm = spacing_mm, .origin_P_mm = glm::dvec3(first_mm)};
    std::vector<std::uint8_t> solid(grid.voxelCount());
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const double depth_mm = 5.0 - glm::length(grid.origin_P_mm + grid.spacing_mm * glm::dvec3(ijk));
      solid[v] = static_cast<std::uint8_t>(255.0 * std::clamp(0.5 + depth_mm / spacing_mm, 0.0, 1.0));
    });
    const OriginalSurface surface(grid, solid);
    for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(0.6, 0.8, 0), glm::dvec3(0.48, -0.6, 0.64)})
      for (const double r_mm : {3.5, 5.0, 6.5}) {
        EXPECT_GT(glm::dot(surface.normalAt(r_mm * direction), direction), 0.98) << r_mm << " " << spacing_mm;
        EXPECT_NEAR(surface.distance_mm(r_mm * direction), r_mm - 5.0, 0.1) << spacing_mm;
      }
    EXPECT_EQ(surface.normalAt({50.0, 0.0, 0.0}), glm::dvec3(0.0));
    EXPECT_EQ(surface.normalAt(glm::dvec3(std::nan(""))), glm::dvec3(0.0));
  }
}

}  // namespace
}  // namespace app
