#include "assets/import/dicom/slice_stack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using assets::SliceAxes;
using assets::SliceStack;

std::vector<glm::dvec3> row(const std::vector<double>& places_mm, const glm::dvec3& along = {0, 0, 1}) {
  std::vector<glm::dvec3> positions;
  for (const double at : places_mm) positions.push_back(glm::dvec3(7, -3, 11) + at * along);
  return positions;
}

TEST(SliceStack, OrdersShuffledSlicesAlongTheNormal) {
  const SliceStack stack = assets::stackOf(row({0.8, 0.0, 1.2, 0.4}), {});
  EXPECT_EQ(stack.order, (std::vector<std::size_t>{1, 3, 0, 2}));
  EXPECT_TRUE(stack.is_regular);
  EXPECT_NEAR(stack.step_mm, 0.4, 1e-12);
  EXPECT_NEAR(stack.tilt_deg, 0.0, 1e-5);
}

TEST(SliceStack, SaysWhichSlicesAreMissing) {
  const SliceStack stack = assets::stackOf(row({0, 0.4, 0.8, 2.4, 2.8, 3.2, 3.6}), {});
  EXPECT_FALSE(stack.is_regular);
  EXPECT_TRUE(stack.changes.empty());
  ASSERT_EQ(stack.gaps.size(), 1U);
  EXPECT_EQ(stack.gaps[0].before, 2U);
  EXPECT_EQ(stack.gaps[0].missing_slices, 3);
  EXPECT_NEAR(stack.gaps[0].missing_mm, 1.2, 1e-9);
}

TEST(SliceStack, AGapOfFourOrOfNoWholeStepsIsNotToBeBridged) {
  EXPECT_FALSE(assets::stackOf(row({0, 0.4, 0.8, 2.8, 3.2, 3.6}), {}).gaps.at(0).missing_slices);
  EXPECT_FALSE(assets::stackOf(row({0, 0.4, 0.8, 1.8, 2.2, 2.6}), {}).gaps.at(0).missing_slices);
}

TEST(SliceStack, ALastingChangeOfTheStepIsNoGap) {
  const SliceStack stack = assets::stackOf(row({0, 0.4, 0.8, 1.2, 2.0, 2.8, 3.6, 4.4}), {});
  EXPECT_TRUE(stack.gaps.empty());
  EXPECT_EQ(stack.changes, (std::vector<std::size_t>{3}));
  const assets::EvenSlices even = assets::evenSlices(stack);
  EXPECT_EQ(even.slices.size(), 12U);
  EXPECT_NEAR(even.step_mm, 0.4, 1e-9);
  EXPECT_FALSE(even.slices[3].isInvented());
  EXPECT_TRUE(even.slices[4].isInvented());
  EXPECT_NEAR(even.slices[4].share, 0.5, 1e-9);
}

TEST(SliceStack, FindsDoubles) {
  const SliceStack stack = assets::stackOf(row({0, 0.4, 0.8, 0.4, 1.2, 0.4}), {});
  EXPECT_EQ(stack.order.size(), 4U);
  EXPECT_TRUE(stack.is_regular);
  ASSERT_EQ(stack.doubles.size(), 1U);
  EXPECT_EQ(stack.doubles[0], (std::vector<std::size_t>{1, 3, 5}));
}

// Axes tilted about x by the angle, positions straight up: the angle comes from both.
TEST(SliceStack, MeasuresTheTiltOfTheGantry) {
  for (const double tilt_deg : {-18.5, 5.0, 15.0}) {
    const double a = tilt_deg * std::numbers::pi / 180.0;
    const SliceAxes axes{{1, 0, 0}, {0, std::cos(a), std::sin(a)}};
    const SliceStack stack = assets::stackOf(row({0, 0.4, 0.8, 1.2}), axes);
    EXPECT_NEAR(stack.tilt_deg, std::abs(tilt_deg), 1e-6);
    EXPECT_NEAR(stack.step_mm, 0.4 * std::cos(a), 1e-9);
    EXPECT_NEAR(glm::distance(stack.per_mm_P * stack.step_mm, glm::dvec3(0, 0, 0.4)), 0.0, 1e-9);
  }
}

TEST(SliceStack, SeesSlicesThatAreShiftedSideways) {
  auto positions = row({0, 0.4, 0.8, 1.2, 1.6});
  positions[2].x += 0.7;
  EXPECT_NEAR(assets::stackOf(positions, {}).sideways_mm, 0.7, 1e-9);
}

TEST(SliceStack, MendsDirectionsWithinOnePercentAndRefusesWorse) {
  const auto axesOf = [](double skew, double length) {
    return assets::sliceAxes(glm::dmat2x3(glm::dvec3(length, 0, 0), glm::dvec3(skew, 1, 0)));
  };
  ASSERT_TRUE(axesOf(0, 1));
  EXPECT_FALSE(axesOf(0, 1)->is_mended);
  ASSERT_TRUE(axesOf(0.005, 1.005));
  EXPECT_TRUE(axesOf(0.005, 1.005)->is_mended);
  EXPECT_NEAR(glm::dot(axesOf(0.005, 1)->row_P, axesOf(0.005, 1)->column_P), 0.0, 1e-12);
  EXPECT_FALSE(axesOf(0.05, 1));
  EXPECT_FALSE(axesOf(0, 0));
  EXPECT_FALSE(axesOf(0, 1.1));
}

// However many slices are lost and wherever: what is made covers exactly what is there, and what is there stays.
TEST(SliceStack, NeverSquashesWhatIsLeft) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> places_mm;
    for (int k = 0; k < 40; ++k)
      if (k == 0 || k == 39 || random() % 8 != 0) places_mm.push_back(0.3 * k);
    const SliceStack stack = assets::stackOf(row(places_mm), {});
    const assets::EvenSlices even = assets::evenSlices(stack);
    EXPECT_NEAR(even.step_mm * static_cast<double>(even.slices.size() - 1), 39 * 0.3, 0.15);
    EXPECT_NEAR(even.step_mm, 0.3, 1e-9);
  }
}

}  // namespace
