#include "assets/synthetic/built_in_teeth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "assets/load_error.h"

namespace {

using assets::BuiltInTooth;
using assets::CanalPlace;
using assets::ToothCanal;
using assets::ToothCanals;

constexpr int kRing = 16;

BuiltInTooth toothAt(int position, bool right = false) {
  assets::JawParameters jaw;
  jaw.right_side = right;
  return assets::builtInTooth(jaw, (right ? 40 : 30) + position);
}

/// Points of the wall around a place, in the tooth's frame.
std::vector<glm::dvec3> ringAt(const BuiltInTooth& tooth, const ToothCanal& canal, double along_mm) {
  const CanalPlace place = canal.at(along_mm);
  const glm::dvec3 along = glm::normalize(tooth.frame.local(canal.at(along_mm + 0.1).p_P_mm) -
                                          tooth.frame.local(canal.at(along_mm - 0.1).p_P_mm));
  const glm::dvec3 wide = glm::normalize(glm::dvec3(0.0, 1.0, 0.0) - along.y * along), narrow = glm::cross(wide, along);
  std::vector<glm::dvec3> ring;
  for (int n = 0; n < kRing; ++n) {
    const double turn = 2.0 * std::numbers::pi * n / kRing;
    ring.push_back(tooth.frame.local(place.p_P_mm) + place.narrow_mm * std::cos(turn) * narrow +
                   place.wide_mm * std::sin(turn) * wide);
  }
  return ring;
}

TEST(BuiltInTeeth, EveryCanalHasHalfAMillimetreOfDentineAroundTo2mmFromItsForamen) {
  for (int position = 4; position <= 8; ++position) {
    const BuiltInTooth tooth = toothAt(position);
    for (const ToothCanal& canal : assets::canalsOf(tooth).canals) {
      double least_mm = 9.0, at_mm = 0.0;
      for (double along_mm = 0.0; along_mm <= canal.length_mm() - 2.0; along_mm += 0.1)
        for (const glm::dvec3& p : ringAt(tooth, canal, along_mm))
          if (const double wall_mm = -tooth.placed.shape.outer_mm(p); wall_mm < least_mm)
            least_mm = wall_mm, at_mm = along_mm;
      EXPECT_GT(least_mm, 0.5) << tooth.fdi << " " << canal.name << " at " << at_mm;
      for (const glm::dvec3& p : ringAt(tooth, canal, canal.constriction_mm))
        EXPECT_LT(tooth.placed.shape.outer_mm(p), -0.15) << tooth.fdi << " " << canal.name << ": constriction";
    }
  }
}

// The shape's own distances are of a lattice: points of its surface say the same.
TEST(BuiltInTeeth, WallsAreAsThickToThePointsOfTheSurface) {
  const BuiltInTooth tooth = toothAt(6);
  const std::vector<glm::dvec3> surface = tooth.placed.shape.surfacePoints_mm();
  for (const ToothCanal& canal : assets::canalsOf(tooth).canals)
    for (double along_mm = 0.5; along_mm < canal.length_mm() - 2.0; along_mm += 1.5)
      for (const glm::dvec3& p : ringAt(tooth, canal, along_mm)) {
        double least_mm = 9.0;
        for (const glm::dvec3& q : surface) least_mm = std::min(least_mm, glm::distance(p, q));
        EXPECT_GT(least_mm, 0.5) << canal.name << " at " << along_mm;
        EXPECT_NEAR(-tooth.placed.shape.outer_mm(p), least_mm, 0.15) << canal.name << " at " << along_mm;
      }
}

TEST(BuiltInTeeth, ForamenAndConstrictionLieWhereAnatomyHasThem) {
  for (int position = 4; position <= 8; ++position) {
    const BuiltInTooth tooth = toothAt(position);
    for (const ToothCanal& canal : assets::canalsOf(tooth).canals) {
      const std::string which = std::to_string(tooth.fdi) + " " + canal.name;
      EXPECT_NEAR(tooth.placed.shape.outer_mm(tooth.frame.local(canal.foramen_P_mm())), 0.0, 0.02) << which;
      const double lateral_mm = glm::distance(canal.foramen_P_mm(), canal.apex_P_mm);
      EXPECT_GE(lateral_mm, 0.5) << which;
      EXPECT_LE(lateral_mm, 2.0) << which;
      const double short_mm = canal.length_mm() - canal.constriction_mm;
      EXPECT_GE(short_mm, 0.5) << which;
      EXPECT_LE(short_mm, 1.5) << which;
      EXPECT_NEAR(canal.smallestWidth_mm(), 0.28, 0.005) << which;
      // A file of 25 mm reaches it from the cusp.
      EXPECT_GT(canal.workingLength_mm(), 14.0) << which;
      EXPECT_LT(canal.workingLength_mm(), 22.0) << which;
      for (const CanalPlace& place : canal.places) EXPECT_GE(place.wide_mm, place.narrow_mm) << which;
    }
  }
}

TEST(BuiltInTeeth, AFirstMolarHasTwoCurvedMesialCanalsAndAnOvalDistalOne) {
  const ToothCanals all = assets::canalsOf(toothAt(6));
  ASSERT_EQ(all.canals.size(), 3U);
  const double apart_mm = glm::distance(all.canals[0].orifice_P_mm(), all.canals[1].orifice_P_mm());
  EXPECT_GE(apart_mm, 3.6);
  EXPECT_LE(apart_mm, 3.8);
  for (int mesial = 0; mesial < 2; ++mesial)
    EXPECT_GT(all.canals[static_cast<std::size_t>(mesial)].schneider_rad * 180.0 / std::numbers::pi, 25.0);
  EXPECT_LT(all.canals[2].schneider_rad * 180.0 / std::numbers::pi, 20.0);
  EXPECT_GT(all.canals[2].places[0].wide_mm, 2.0 * all.canals[2].places[0].narrow_mm);
  EXPECT_FALSE(all.canals[1].joins);

  const ToothCanals second = assets::canalsOf(toothAt(7));
  ASSERT_EQ(second.canals[1].joins, 0U);
  EXPECT_EQ(second.canals[1].foramen_P_mm(), second.canals[0].foramen_P_mm());
}

TEST(BuiltInTeeth, TheChamberOfAMolarIsAsHighAsMeasured) {
  for (const int position : {6, 7, 8}) {
    const ToothCanals all = assets::canalsOf(toothAt(position));
    const assets::PulpDistance pulp(all);
    double height_mm = 0.0;
    for (double z = -4.0; z < 4.0; z += 0.001)
      if (pulp.at_mm(all.frame.inP({0.0, 0.0, z})) < 0.0) height_mm += 0.001;
    EXPECT_NEAR(height_mm, 1.57, 0.01) << position;
    // From the buccal cusp to the roof 6.36 +-0.93 mm in lower molars.
    EXPECT_NEAR(all.frame.local(all.canals[0].reference_P_mm).z - all.chamber.roof_mm, 6.36, 0.93) << position;
  }
}

TEST(BuiltInTeeth, ARightJawIsTheMirrorImage) {
  const ToothCanals left = assets::canalsOf(toothAt(8, false)), right = assets::canalsOf(toothAt(8, true));
  ASSERT_EQ(left.canals.size(), right.canals.size());
  const assets::PulpDistance of_left(left), of_right(right);
  std::mt19937 random(5);
  std::normal_distribution<double> aside_mm(0.0, 0.5);
  for (std::size_t c = 0; c < left.canals.size(); ++c)
    for (std::size_t n = 0; n < left.canals[c].places.size(); ++n) {
      const glm::dvec3 p = left.canals[c].places[n].p_P_mm + glm::dvec3(aside_mm(random), aside_mm(random), 0.0);
      const glm::dvec3 mirror(-1.0, 1.0, 1.0);
      EXPECT_LT(glm::distance(right.canals[c].places[n].p_P_mm, mirror * left.canals[c].places[n].p_P_mm), 1e-9);
      EXPECT_NEAR(of_left.at_mm(p), of_right.at_mm(mirror * p), 1e-9);
    }
}

TEST(BuiltInTeeth, AToothThatTheJawHasNotIsRefused) {
  EXPECT_THROW(assets::builtInTooth({}, 36), assets::LoadError);
  EXPECT_THROW(assets::builtInTooth({}, 41), assets::LoadError);
}

// A round canal: the distance to the nearest of many places of its axis, less the radius there.
TEST(PulpDistance, OfARoundCanalIsThatOfASlowTwin) {
  ToothCanals all = assets::canalsOf(toothAt(6));
  all.chamber.outline_mm = {{40.0, 0.0}};
  all.chamber.horns.clear();
  all.canals.resize(1);
  for (CanalPlace& place : all.canals[0].places) place.wide_mm = place.narrow_mm;
  const ToothCanal& canal = all.canals[0];
  const assets::PulpDistance pulp(all);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(2.0, canal.length_mm() - 2.5);
  std::normal_distribution<double> aside_mm(0.0, 0.4);
  for (int n = 0; n < 400; ++n) {
    const glm::dvec3 p =
        canal.at(along(random)).p_P_mm + glm::dvec3(aside_mm(random), aside_mm(random), aside_mm(random));
    double least_mm = 9.0;
    for (double mm = 0.0; mm < canal.length_mm(); mm += 0.002) {
      const CanalPlace place = canal.at(mm);
      least_mm = std::min(least_mm, glm::distance(p, place.p_P_mm) - place.narrow_mm);
    }
    EXPECT_NEAR(pulp.at_mm(p), least_mm, 1e-3) << n;
  }
}

TEST(PulpDistance, WhatTwoCanalsShareIsAsWideAsOne) {
  for (const int position : {7, 8}) {
    const ToothCanals all = assets::canalsOf(toothAt(position));
    const assets::PulpDistance pulp(all);
    for (std::size_t canal = 0; canal < 2; ++canal)
      for (double mm = 0.2; mm < 1.6; mm += 0.1) {
        const CanalPlace place = all.canals[canal].at(all.canals[canal].length_mm() - mm);
        EXPECT_NEAR(pulp.at_mm(place.p_P_mm), -place.narrow_mm, 0.01) << position << " " << canal << " at " << mm;
      }
  }
}

TEST(PulpDistance, SchneidersAngleOfPlacesIsThatOfTheClosedForm) {
  for (int position = 4; position <= 7; ++position)
    for (const ToothCanal& canal : assets::canalsOf(toothAt(position)).canals)
      EXPECT_NEAR(assets::schneider_rad(canal.places), canal.schneider_rad, 0.01) << position << " " << canal.name;
}

}  // namespace
