#include "assets/import/tooth_site.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "assets/import/tooth_axis.h"
#include "assets/synthetic/jaw.h"
#include "assets/tooth.h"

namespace {

using assets::CtVolume;
using assets::numberThirdMolar;
using assets::OperativeSite;
using assets::siteAtTooth;
using assets::Tissue;
using assets::VolumeGrid;

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)) * 180.0 / std::acos(-1.0);
}

const VolumeGrid kGrid{{60, 60, 50}, 0.5, {100, 20, -40}};

CtVolume emptyVolume() {
  CtVolume ct;
  ct.grid = kGrid;
  ct.label.assign(kGrid.voxelCount(), 0);
  return ct;
}

/// A tooth 18 mm long and 9 mm wide, its upper third enamel, about `middle` with its crown towards `crown`.
void addTooth(CtVolume& ct, const glm::dvec3& middle, const glm::dvec3& crown) {
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i) {
        const glm::dvec3 p = ct.grid.centre_P_mm({i, j, k}) - middle;
        const double along = glm::dot(p, crown);
        if (std::abs(along) > 9.0 || glm::length(p - along * crown) > 4.5) continue;
        ct.label[ct.grid.index({i, j, k})] = static_cast<std::uint8_t>(along > 3.0 ? Tissue::enamel : Tissue::dentine);
      }
}

void addOtherTeeth(CtVolume& ct, int first_i, int end_i, int j) {
  for (int i = first_i; i < end_i; ++i)
    ct.label[ct.grid.index({i, j, 20})] = static_cast<std::uint8_t>(Tissue::other_teeth);
}

TEST(ToothNumber, HasQuadrantSideJawAndName) {
  EXPECT_TRUE(assets::isToothNumber(11) && assets::isToothNumber(48) && assets::isToothNumber(51) &&
              assets::isToothNumber(85));
  for (const int fdi : {-38, 0, 10, 19, 20, 49, 50, 56, 86, 91, 100}) EXPECT_FALSE(assets::isToothNumber(fdi)) << fdi;
  EXPECT_EQ(assets::toothName(48), "lower right third molar");
  EXPECT_EQ(assets::toothName(21), "upper left central incisor");
  EXPECT_EQ(assets::toothName(75), "lower left primary second molar");
  for (const int fdi : {11, 18, 41, 48, 51, 85}) EXPECT_TRUE(assets::isRight(fdi)) << fdi;
  for (const int fdi : {21, 38, 61, 75}) EXPECT_FALSE(assets::isRight(fdi)) << fdi;
  for (const int fdi : {18, 21, 55, 65}) EXPECT_TRUE(assets::isUpper(fdi)) << fdi;
  for (const int fdi : {38, 41, 75, 85}) EXPECT_FALSE(assets::isUpper(fdi)) << fdi;
}

TEST(ToothSite, IsAtItsHardTissueAndPointsToItsEnamel) {
  std::mt19937 random(2);
  std::normal_distribution<double> component;
  for (int trial = 0; trial < 6; ++trial) {
    const glm::dvec3 crown = glm::normalize(glm::dvec3(component(random), component(random), component(random)));
    CtVolume ct = emptyVolume();
    addTooth(ct, {115, 35, -28}, crown);
    EXPECT_EQ(numberThirdMolar(ct), assets::ThirdMolar::of_unknown_side);
    EXPECT_EQ(numberThirdMolar(ct, 48), assets::ThirdMolar::numbered);
    const auto site = siteAtTooth(ct, 48);
    ASSERT_TRUE(site);
    EXPECT_LT(glm::distance(site->centre_P_mm, glm::dvec3(115, 35, -28)), 0.1);
    EXPECT_LT(degreesBetween(site->axis_P, crown), 3.0);
  }
}

TEST(ToothSite, TakesItsSideFromTheFrontTeeth) {
  CtVolume ct = emptyVolume();
  addTooth(ct, {112, 40, -28}, {0, 0, 1});
  CtVolume cropped_right = ct;  // front teeth to the left of the molar: it is a right one
  addOtherTeeth(cropped_right, 45, 58, 2);
  addOtherTeeth(cropped_right, 0, 20, 40);  // a neighbour far back says nothing
  numberThirdMolar(cropped_right, 38);
  EXPECT_TRUE(siteAtTooth(cropped_right, 48)) << "for any requested tooth";
  CtVolume cropped_left = ct;
  addOtherTeeth(cropped_left, 2, 12, 2);
  addOtherTeeth(cropped_left, 30, 59, 40);
  numberThirdMolar(cropped_left);
  EXPECT_TRUE(siteAtTooth(cropped_left, 38));
}

TEST(ToothSite, IsNoneWithoutLabels) {
  CtVolume ct = emptyVolume();
  std::ranges::fill(ct.label, std::uint8_t{1});
  EXPECT_EQ(numberThirdMolar(ct, 48), assets::ThirdMolar::none);
  EXPECT_FALSE(siteAtTooth(ct, 48));
  EXPECT_TRUE(assets::toothVolumes_mm3(ct).empty());
}

/// A tooth with a number only; its enamel is recognised by grey values.
TEST(ToothSite, IsAnyNumberedTooth) {
  CtVolume ct = emptyVolume();
  addTooth(ct, {115, 35, -28}, {0, 0.6, -0.8});
  ct.tooth.assign(ct.label.size(), 0);
  ct.hounsfield.assign(ct.label.size(), 0);
  for (std::size_t v = 0; v < ct.label.size(); ++v) {
    if (ct.label[v] == 0) continue;
    ct.hounsfield[v] = Tissue{ct.label[v]} == Tissue::enamel ? 2500 : 1650;
    ct.label[v] = static_cast<std::uint8_t>(Tissue::other_teeth);
    ct.tooth[v] = 26;
  }
  const auto site = siteAtTooth(ct, 26);
  ASSERT_TRUE(site);
  EXPECT_EQ(site->fdi, 26);
  EXPECT_LT(degreesBetween(site->axis_P, {0, 0.6, -0.8}), 3.0);
  EXPECT_NEAR(assets::toothVolumes_mm3(ct).at(26), 3.1416 * 4.5 * 4.5 * 18.0, 40.0);
  EXPECT_FALSE(siteAtTooth(ct, 27));
  // Without any enamel: along the tooth, towards the other jaw.
  std::ranges::fill(ct.hounsfield, std::int16_t{1650});
  EXPECT_LT(degreesBetween(siteAtTooth(ct, 26)->axis_P, {0, 0.6, -0.8}), 3.0);
}

CtVolume cropped(const CtVolume& ct, glm::ivec3 low, glm::ivec3 end) {
  CtVolume piece;
  piece.grid = {end - low, ct.grid.spacing_mm, ct.grid.centre_P_mm(low)};
  for (int k = low.z; k < end.z; ++k)
    for (int j = low.y; j < end.y; ++j)
      for (int i = low.x; i < end.x; ++i) {
        piece.label.push_back(ct.label[ct.grid.index({i, j, k})]);
        piece.tooth.push_back(ct.tooth[ct.grid.index({i, j, k})]);
      }
  return piece;
}

/// Bent roots, complete or cut off, crowns worn or cut by the scan's border.
TEST(ToothAxis, IsThatOfTheCrownForIncompleteTeeth) {
  for (const double angle_deg : {0.0, 45.0, 90.0}) {
    const auto patient =
        assets::syntheticJaw({.winter_angle_deg = angle_deg, .mandibular_canal_distance_mm = 1.0, .spacing_mm = 0.4});
    const OperativeSite& site = *patient.site;
    const CtVolume& ct = patient.ct;
    EXPECT_LT(degreesBetween(assets::toothAxis_P(ct, 48), site.axis_P), 2.0) << angle_deg;
    CtVolume without_roots = ct, worn = ct, other_root = ct;
    for (int k = 0; k < ct.grid.size.z; ++k)
      for (int j = 0; j < ct.grid.size.y; ++j)
        for (int i = 0; i < ct.grid.size.x; ++i) {
          const std::size_t v = ct.grid.index({i, j, k});
          const glm::dvec3 from_middle = ct.grid.centre_P_mm({i, j, k}) - site.centre_P_mm;
          const double along_mm = glm::dot(from_middle, site.axis_P);
          if (along_mm < -4.0) without_roots.tooth[v] = 0;
          if (along_mm > 6.0) worn.tooth[v] = 0;
          if (along_mm < -3.0 && from_middle.y > 0.0) other_root.tooth[v] = 0;
        }
    EXPECT_LT(degreesBetween(assets::toothAxis_P(without_roots, 48), site.axis_P), 2.0) << angle_deg;
    EXPECT_LT(degreesBetween(assets::toothAxis_P(worn, 48), site.axis_P), 2.0) << angle_deg;
    EXPECT_LT(degreesBetween(assets::toothAxis_P(other_root, 48), site.axis_P), 2.0) << angle_deg;
    const glm::ivec3 middle(ct.grid.indexFromPoint(site.centre_P_mm)), size = ct.grid.size;
    EXPECT_LT(degreesBetween(assets::toothAxis_P(cropped(ct, {0, 0, 0}, {size.x, middle.y, size.z}), 48), site.axis_P),
              22.0);
    EXPECT_LT(degreesBetween(assets::toothAxis_P(cropped(ct, {0, 0, 0}, {middle.x, size.y, size.z}), 48), site.axis_P),
              22.0);
  }
}

}  // namespace
