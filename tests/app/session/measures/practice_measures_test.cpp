#include "app/session/measures/practice_measures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/session/measures/measure_named.h"

namespace app {
namespace {

using test::valueNamed;

using assets::inBlock;
using assets::PracticeTask;

/// What is left when all within a region is gone.
template <class Region>
std::vector<MeasureValue> after(PracticeTask task, const Region& is_gone) {
  const assets::Patient block = assets::practiceBlock(task);
  std::vector<std::uint8_t> left = block.ct.solid;
  assets::forVoxels(block.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (is_gone(inBlock(block.ct.grid.centre_P_mm(ijk)))) left[v] = 0;
  });
  return practiceMeasures(task, block.ct.grid, block.ct.label, block.ct.solid, left);
}

TEST(PracticeMeasures, AnUntouchedPlateIsThreeMillimetresAndAThinnedOneIsOne) {
  const auto untouched = after(PracticeTask::plate, [](const glm::dvec3&) { return false; });
  EXPECT_NEAR(valueNamed(untouched, "B.plate_mean"), 3.0, 0.15);
  const auto thinned = after(PracticeTask::plate, [](const glm::dvec3& q) { return q.z > -2.0; });
  EXPECT_NEAR(valueNamed(thinned, "B.plate_mean"), 1.0, 0.15);
  EXPECT_NEAR(valueNamed(thinned, "B.plate_least"), 1.0, 0.25);
  EXPECT_EQ(valueNamed(thinned, "B.plate_through"), 0.0);
}

TEST(PracticeMeasures, AHoleInThePlateIsItsArea) {
  const auto holed =
      after(PracticeTask::plate, [](const glm::dvec3& q) { return std::abs(q.x) < 1.0 && std::abs(q.y) < 1.0; });
  EXPECT_NEAR(valueNamed(holed, "B.plate_through"), 4.0, 0.8);
  EXPECT_NEAR(valueNamed(holed, "B.plate_least"), 0.0, 1e-9);
}

TEST(PracticeMeasures, ABallIsBareWhereNothingStandsOverIt) {
  EXPECT_EQ(valueNamed(after(PracticeTask::ball, [](const glm::dvec3&) { return false; }), "B.ball_bare"), 0.0);
  const auto all = after(PracticeTask::ball, [](const glm::dvec3& q) {
    return assets::fromTarget_mm(PracticeTask::ball, assets::fromBlock(q)) < 0.0 &&
           glm::distance(q, glm::dvec3(0.0, 0.0, assets::kBallMiddle_mm)) > assets::kBallRadius_mm + 0.2;
  });
  EXPECT_GT(valueNamed(all, "B.ball_bare"), 0.97);
  EXPECT_EQ(valueNamed(all, "B.ball_cut"), 0.0);
  // Of the places over the upper half, evenly spread in height, those with x > 0.
  const auto half = after(PracticeTask::ball, [](const glm::dvec3& q) {
    return q.x > 0.0 && glm::distance(q, glm::dvec3(0.0, 0.0, assets::kBallMiddle_mm)) > assets::kBallRadius_mm + 0.2;
  });
  EXPECT_NEAR(valueNamed(half, "B.ball_bare"), 0.5, 0.06);
}

TEST(PracticeMeasures, WhatIsCutOfTheBallIsItsVolume) {
  const auto cut = after(PracticeTask::ball, [](const glm::dvec3& q) { return q.z > assets::kBallMiddle_mm; });
  constexpr double kHalf_mm3 = 2.0 / 3.0 * 3.14159 * 2.5 * 2.5 * 2.5;
  EXPECT_NEAR(valueNamed(cut, "B.ball_cut"), kHalf_mm3, 0.05 * kHalf_mm3);
}

}  // namespace
}  // namespace app
