#include "assets/import/third_molar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "assets/tissue.h"

namespace {

using assets::thirdMolarSite;
using assets::Tissue;
using assets::VolumeGrid;

/// A tooth 18 mm long and 9 mm wide, its upper third enamel, about `middle` with its crown towards `crown`.
void addTooth(const VolumeGrid& grid, std::vector<std::uint8_t>& label, const glm::dvec3& middle,
              const glm::dvec3& crown) {
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        const glm::dvec3 p = grid.centre_P_mm({i, j, k}) - middle;
        const double along = glm::dot(p, crown);
        if (std::abs(along) > 9.0 || glm::length(p - along * crown) > 4.5) continue;
        label[grid.index({i, j, k})] = static_cast<std::uint8_t>(along > 3.0 ? Tissue::enamel : Tissue::dentine);
      }
}

void addOtherTeeth(const VolumeGrid& grid, std::vector<std::uint8_t>& label, int first_i, int end_i, int j) {
  for (int i = first_i; i < end_i; ++i) label[grid.index({i, j, 20})] = static_cast<std::uint8_t>(Tissue::other_teeth);
}

const VolumeGrid kGrid{{60, 60, 50}, 0.5, {100, 20, -40}};

TEST(ThirdMolar, IsWhereItsHardTissueIsAndPointsToItsEnamel) {
  std::mt19937 random(2);
  std::normal_distribution<double> component;
  for (int trial = 0; trial < 6; ++trial) {
    const glm::dvec3 crown = glm::normalize(glm::dvec3(component(random), component(random), component(random)));
    std::vector<std::uint8_t> label(kGrid.voxelCount(), 0);
    addTooth(kGrid, label, {115, 35, -28}, crown);
    const auto site = thirdMolarSite(kGrid, label);
    ASSERT_TRUE(site.known);
    EXPECT_LT(glm::distance(site.third_molar_P_mm, glm::dvec3(115, 35, -28)), 0.1);
    EXPECT_GT(glm::dot(site.crown_direction_P, crown), std::cos(0.05));
  }
}

TEST(ThirdMolar, TakesItsSideFromTheFrontTeeth) {
  std::vector<std::uint8_t> label(kGrid.voxelCount(), 0);
  addTooth(kGrid, label, {112, 40, -28}, {0, 0, 1});
  auto cropped_right = label;  // front teeth to the left of the molar: it is a right one
  addOtherTeeth(kGrid, cropped_right, 45, 58, 2);
  addOtherTeeth(kGrid, cropped_right, 0, 20, 40);  // a neighbour far back says nothing
  EXPECT_EQ(thirdMolarSite(kGrid, cropped_right).tooth_fdi, 48);
  auto cropped_left = label;
  addOtherTeeth(kGrid, cropped_left, 2, 12, 2);
  addOtherTeeth(kGrid, cropped_left, 30, 59, 40);
  EXPECT_EQ(thirdMolarSite(kGrid, cropped_left).tooth_fdi, 38);
}

TEST(ThirdMolar, IsUnknownWithoutLabels) {
  EXPECT_FALSE(thirdMolarSite(kGrid, std::vector<std::uint8_t>(kGrid.voxelCount(), 1)).known);
}

}  // namespace
