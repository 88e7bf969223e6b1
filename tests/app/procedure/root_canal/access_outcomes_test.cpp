// Access measures against closed forms: a round tooth about z with a round chamber and one canal down its axis.
#include "app/procedure/root_canal/access_outcomes.h"

#include <gtest/gtest.h>

#include "app/procedure/root_canal/perforation.h"
#include "tests/app/procedure/root_canal/at_once.h"
#include "tests/app/procedure/root_canal/shapes.h"

namespace app::round_tooth {
namespace {

using assets::Tissue;
using shapes::Depth;
using shapes::ShapeSolid;

constexpr double kTooth_mm = 2.4, kTop_mm = 7.0, kBottom_mm = -8.0, kEnamel_mm = 3.025;
constexpr double kChamber_mm = 1.5, kRoof_mm = 0.4, kFloor_mm = -1.17, kCanal_mm = 0.15;
constexpr double kPi = std::numbers::pi;

double aside(const glm::dvec3& p) { return std::hypot(p.x - 0.007, p.y + 0.011); }
/// Positive within.
double cylinder(double aside_mm, double radius_mm, double z, double low_mm, double high_mm) {
  return std::min({radius_mm - aside_mm, z - low_mm, high_mm - z});
}
double pulp(const glm::dvec3& p) {
  return std::max(cylinder(aside(p), kChamber_mm, p.z, kFloor_mm, kRoof_mm),
                  cylinder(aside(p), kCanal_mm, p.z, kBottom_mm - 1.0, kFloor_mm + 0.1));
}
double wholeTooth(const glm::dvec3& p) {
  return std::min(cylinder(aside(p), kTooth_mm, p.z, kBottom_mm, kTop_mm), -pulp(p));
}
Tissue tissueOf(const glm::dvec3& p) {
  if (cylinder(aside(p), kTooth_mm, p.z, kBottom_mm, kTop_mm) < 0.0) return Tissue::ligament;
  if (pulp(p) > 0.0) return Tissue::pulp;
  return p.z > kEnamel_mm ? Tissue::enamel : Tissue::dentine;
}

const assets::VolumeGrid& grid() {
  static const assets::VolumeGrid kGrid = shapes::gridOf({-2.7, -2.7, -8.5}, {2.7, 2.7, 7.5}, 0.05);
  return kGrid;
}
const ToothBlocks& before() {
  static const ToothBlocks kBefore(shapes::ShapeTooth(grid(), wholeTooth, tissueOf));
  return kBefore;
}
/// What is left where `taken` is positive.
ShapeSolid cut(const Depth& taken) {
  return {grid(), [&taken](const glm::dvec3& p) { return std::min(wholeTooth(p), -taken(p)); }};
}
assets::ToothCanals tooth() {
  assets::ToothCanals all;
  all.fdi = 36;
  all.chamber = {{{0.007, -0.011}}, kChamber_mm, kRoof_mm, kFloor_mm, {}};
  all.canals.push_back(shapes::straightCanal(kFloor_mm - kBottom_mm, kCanal_mm, {0.007, -0.011, kFloor_mm}));
  all.canals[0].reference_P_mm = {0.0, 0.0, kTop_mm};
  return all;
}

/// Straight down to the chamber.
double opening(const glm::dvec3& p, double radius_mm) {
  return cylinder(aside(p), radius_mm, p.z, kRoof_mm - 0.1, kTop_mm + 1.0);
}

TEST(AccessOutcomes, TheRoofThatIsLeftIsItsRing) {
  for (const double r : {1.0, 1.3}) {
    const RoofOutcome roof = roofOutcome(cut([r](const glm::dvec3& p) { return opening(p, r); }), tooth());
    const double ring_mm2 = kPi * (kChamber_mm * kChamber_mm - r * r);
    EXPECT_NEAR(roof.removed, r * r / (kChamber_mm * kChamber_mm), 0.02) << r;
    EXPECT_NEAR(roof.overhang_mm2, ring_mm2, 0.15) << r;
    EXPECT_NEAR(roof.overhang_mm3, ring_mm2, 0.2) << r << ": one millimetre of it";
  }
  EXPECT_EQ(roofOutcome(before(), tooth()).removed, 0.0);
  EXPECT_EQ(roofOutcome(cut([](const glm::dvec3& p) { return opening(p, 1.7); }), tooth()).removed, 1.0);
}

TEST(AccessOutcomes, AnOutlineThatWasOpenFromTheBeginningCounts) {
  const auto open = [](const glm::dvec3& p) { return std::min(wholeTooth(p), -opening(p, 1.0)); };
  const ToothBlocks opened(shapes::ShapeTooth(grid(), open, tissueOf));
  const OutlineOutcome out = outlineOutcome(opened, ShapeSolid(grid(), open), tooth());
  EXPECT_NEAR(out.opened_mm2, kPi, 0.05);
  EXPECT_EQ(out.too_wide_mm2, 0.0);
  EXPECT_NEAR(out.missing_mm2, out.ideal_mm2 - kPi, 0.05);
}

TEST(AccessOutcomes, AnOutlineIsComparedWithTheChamberAndHalfAMillimetreAroundTheOrifice) {
  const auto opened = [](double radius_mm, const assets::ToothCanals& of) {
    return outlineOutcome(before(), cut([radius_mm](const glm::dvec3& p) { return opening(p, radius_mm); }), of);
  };
  constexpr double kChamber_mm2 = kPi * kChamber_mm * kChamber_mm;
  const OutlineOutcome wide = opened(1.7, tooth());
  EXPECT_NEAR(wide.ideal_mm2, kChamber_mm2, 0.06);
  EXPECT_NEAR(wide.opened_mm2, kPi * 1.7 * 1.7, 0.08);
  EXPECT_NEAR(wide.too_wide_mm2, kPi * 1.7 * 1.7 - kChamber_mm2, 0.12);
  EXPECT_NEAR(wide.missing_mm2, 0.0, 1e-9);
  const OutlineOutcome narrow = opened(1.0, tooth());
  EXPECT_NEAR(narrow.missing_mm2, kChamber_mm2 - kPi, 0.08);
  EXPECT_NEAR(narrow.too_wide_mm2, 0.0, 1e-9);
  // Of a chamber that is hardly wider than its canal the files decide.
  assets::ToothCanals slim = tooth();
  slim.chamber.round_mm = 0.2;
  const OutlineOutcome files = opened(0.3, slim);
  EXPECT_NEAR(files.ideal_mm2, kPi * 0.25, 0.02);
  EXPECT_NEAR(files.missing_mm2, kPi * (0.25 - 0.09), 0.02);
}

TEST(AccessOutcomes, LostTissueIsThatOfTheCylinder) {
  const LostTissue lost =
      shapes::lostAtOnce(before(), cut([](const glm::dvec3& p) { return opening(p, 1.0); }), tooth());
  EXPECT_NEAR(lost.enamel_mm3, kPi * (kTop_mm - kEnamel_mm), 0.005 * kPi * (kTop_mm - kEnamel_mm));
  EXPECT_NEAR(lost.dentine_mm3, kPi * (kEnamel_mm - kRoof_mm), 0.01 * kPi * (kEnamel_mm - kRoof_mm));
  EXPECT_EQ(lost.floor_mm3, 0.0);
  EXPECT_NEAR(lost.deepest_mm, kTop_mm - kRoof_mm, 0.06);
}

TEST(AccessOutcomes, AGougeOfTheFloorIsMeasuredBesideTheOrifice) {
  const auto gouge = [](const glm::dvec3& p) {
    return cylinder(std::hypot(p.x - 1.1, p.y), 0.3, p.z, kFloor_mm - 0.5, kFloor_mm + 0.5);
  };
  const LostTissue lost = shapes::lostAtOnce(before(), cut(gouge), tooth());
  EXPECT_NEAR(lost.floor_mm3, kPi * 0.09 * 0.5, 0.03 * kPi * 0.09 * 0.5);
  EXPECT_NEAR(lost.deepest_mm, kTop_mm - kFloor_mm + 0.5, 0.06);
  // A wider orifice is none.
  const auto flare = [](const glm::dvec3& p) { return cylinder(aside(p), 0.4, p.z, kFloor_mm - 0.5, kFloor_mm + 0.5); };
  EXPECT_EQ(shapes::lostAtOnce(before(), cut(flare), tooth()).floor_mm3, 0.0);
}

TEST(AccessOutcomes, AWallOverAnOrificeHasToBeLeanedAround) {
  // 1 mm over the orifice's middle, at 4 mm height: atan(1 / 4).
  const auto field = [](bool with_wall) {
    return ShapeSolid(grid(), [with_wall](const glm::dvec3& p) {
      const double below = std::min(kFloor_mm - p.z, aside(p) - kCanal_mm);
      const double wall = std::min({1.0 - (p.x - 0.007), p.z - kFloor_mm - 4.0, kFloor_mm + 5.0 - p.z});
      return with_wall ? std::max(below, wall) : below;
    });
  };
  const StraightLine leant = straightLine(field(true), tooth().canals[0]);
  EXPECT_NEAR(leant.least_angle_rad * 180.0 / kPi, std::atan(0.25) * 180.0 / kPi, 0.4);
  EXPECT_FALSE(leant.isFree());
  EXPECT_NEAR(leant.blocked_mm3, kPi * 0.285 * 0.285, 0.03 * kPi * 0.285 * 0.285);
  const StraightLine free = straightLine(field(false), tooth().canals[0]);
  EXPECT_EQ(free.least_angle_rad, 0.0);
  EXPECT_TRUE(free.isFree());
  EXPECT_NEAR(free.blocked_mm3, 0.0, 0.01);
  EXPECT_NEAR(straightLine(before(), tooth().canals[0]).least_angle_rad, 0.5 * kPi, 1e-9) << "the roof is closed";
}

TEST(AccessOutcomes, DepthWarnsAtTheRoofAndAtTheFloor) {
  EXPECT_EQ(depthBand(6.3), DepthBand::fine);
  EXPECT_EQ(depthBand(6.5), DepthBand::amber);
  EXPECT_EQ(depthBand(8.0), DepthBand::red);
  EXPECT_NEAR(belowCusp_mm(tooth(), {0.3, 0.2, 0.6}), 6.4, 1e-12);
}

/// A square tunnel of 1 mm from the axis to beyond the root, about a height.
double tunnel(const glm::dvec3& p, double z_mm) {
  return std::min({p.x, 0.5 - std::abs(p.y), 0.5 - std::abs(p.z - z_mm)});
}

TEST(Perforation, AHoleOfOneSquareMillimetreIsFoundWithItsPlaceAndKind) {
  for (const auto& [z_mm, kind] : {std::pair(-5.0, PerforationKind::strip), std::pair(-0.7, PerforationKind::access)}) {
    const double at_mm = z_mm;
    const auto holes = perforations(before(), cut([at_mm](const glm::dvec3& p) { return tunnel(p, at_mm); }), tooth());
    ASSERT_EQ(holes.size(), 1U) << z_mm;
    EXPECT_NEAR(holes[0].area_mm2, 1.0, 4 * 0.05) << "one ring of voxels";
    EXPECT_EQ(holes[0].kind, kind) << z_mm;
    EXPECT_NEAR(holes[0].middle_P_mm.x, kTooth_mm, 0.1);
    EXPECT_NEAR(holes[0].middle_P_mm.z, z_mm, 0.1);
  }
}

TEST(Perforation, AnObliqueHoleHasTheAreaOfItsOpening) {
  const auto tunnel_of = [](const glm::dvec3& p) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(1.0, 0.5, 0.3)), to = p - glm::dvec3(0.0, 0.0, -5.0);
    const double along = glm::dot(to, way);
    return std::min(along, 0.4 - glm::length(to - along * way));
  };
  const auto holes = perforations(before(), cut(tunnel_of), tooth());
  ASSERT_EQ(holes.size(), 1U);
  // On a wall that it meets at an angle the circle is longer.
  const double lean = std::sqrt(1.25) / std::sqrt(1.34);
  EXPECT_NEAR(holes[0].area_mm2, kPi * 0.16 / lean, 0.05);
}

TEST(Perforation, AForamenThatWasWidenedIsOne) {
  const auto wide = [](const glm::dvec3& p) {
    return cylinder(aside(p), 0.4, p.z, kBottom_mm - 1.0, kBottom_mm + 1.0);
  };
  const auto holes = perforations(before(), cut(wide), tooth());
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_EQ(holes[0].kind, PerforationKind::apex);
  EXPECT_NEAR(holes[0].area_mm2, kPi * (0.16 - kCanal_mm * kCanal_mm), 0.08);
}

TEST(Perforation, TheWayInTheForamenAsItWasAndANotchFromOutsideAreNone) {
  EXPECT_TRUE(perforations(before(), before(), tooth()).empty());
  EXPECT_TRUE(perforations(before(), cut([](const glm::dvec3& p) { return opening(p, 1.0); }), tooth()).empty());
  const auto notch = [](const glm::dvec3& p) { return std::min(p.x - 2.0, tunnel(p, -5.0)); };
  EXPECT_TRUE(perforations(before(), cut(notch), tooth()).empty());
}

}  // namespace
}  // namespace app::round_tooth
