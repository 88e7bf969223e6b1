// Outcomes of a canal against closed forms: canal radius a, prepared b, offset e, root radius Ro
// (reference/sisters 2.4).
#include "app/procedure/root_canal/canal_outcomes.h"

#include <gtest/gtest.h>

#include "app/procedure/root_canal/tooth_blocks.h"
#include "assets/synthetic/built_in_teeth.h"
#include "assets/synthetic/root_canal.h"
#include "tests/app/procedure/root_canal/at_once.h"
#include "tests/app/procedure/root_canal/shapes.h"

namespace app::round_root {
namespace {

using shapes::Depth;
using shapes::ShapeSolid;

constexpr double kA = 0.15, kB = 0.20, kRo = 1.2, kLength_mm = 10.0;
constexpr double kLength_tolerance_mm = 0.005, kDegrees = 180.0 / std::numbers::pi;
/// Off the voxels' centres.
constexpr glm::dvec3 kOff{0.013, -0.007, 0.009};

double aside(const glm::dvec3& p, double e = 0.0) { return std::hypot(p.x - kOff.x - e, p.y - kOff.y); }

double rootWithCanal(const glm::dvec3& p) { return std::min(kRo - aside(p), aside(p) - kA); }

/// Towards the furcation, +x, by e.
Depth prepared(double e) {
  return [e](const glm::dvec3& p) { return std::min(rootWithCanal(p), aside(p, e) - kB); };
}

const assets::VolumeGrid& grid() {
  static const assets::VolumeGrid kGrid = shapes::gridOf({-1.4, -1.4, -10.5}, {1.4, 1.4, 0.5}, 0.04);
  return kGrid;
}
/// Dentine to the root's surface, and pulp.
ToothBlocks blocksOf(const assets::VolumeGrid& around, const Depth& depth, const Depth& from_axis_to_surface) {
  return ToothBlocks(shapes::ShapeTooth(around, depth, [&](const glm::dvec3& p) {
    if (from_axis_to_surface(p) < 0.0) return assets::Tissue::ligament;
    return depth(p) < 0.0 ? assets::Tissue::pulp : assets::Tissue::dentine;
  }));
}
const ToothBlocks& before() {
  static const ToothBlocks kBefore =
      blocksOf(grid(), rootWithCanal, [](const glm::dvec3& p) { return kRo - aside(p); });
  return kBefore;
}
std::vector<assets::ToothCanal> canals() { return {shapes::straightCanal(kLength_mm, kA, {kOff.x, kOff.y, 0.0})}; }

CanalOutcomes outcomesOf(const FineSolid& after) {
  return shapes::outcomesAtOnce(before(), after, canals(), 0, {1.0, 0.0, 0.0});
}

TEST(CanalOutcomes, VolumeIsWhatTheOffsetHoleTakes) {
  for (const double e : {0.02, 0.08}) {
    // Flat ends, 6 mm apart, far from orifice and foramen.
    const ShapeSolid after(grid(), [e](const glm::dvec3& p) {
      return std::min(rootWithCanal(p), std::max(aside(p, e) - kB, std::abs(p.z + 5.0) - 3.0));
    });
    const double due_mm3 = (std::numbers::pi * kB * kB - shapes::lens_mm2(kA, kB, e)) * 6.0;
    EXPECT_NEAR(outcomesOf(after).removed_mm3, due_mm3, 0.005 * due_mm3) << e;
  }
}

TEST(CanalOutcomes, TransportationCentringAndLeastDentineOfAnOffsetHole) {
  for (const double e : {0.02, 0.08}) {
    const CanalOutcomes out = outcomesOf(ShapeSolid(grid(), prepared(e)));
    for (const CanalSection& section : out.sections) {
      EXPECT_NEAR(transportation_mm(section), e < kB - kA ? 2.0 * e : kB - kA + e, kLength_tolerance_mm) << e;
      EXPECT_NEAR(centring(section), std::max(kB - kA - e, 0.0) / (kB - kA + e), 0.04) << e;
      EXPECT_NEAR(section.root_mm[0], kRo, kLength_tolerance_mm) << e;
    }
    EXPECT_NEAR(out.least_wall_mm, kRo - kB - e, kLength_tolerance_mm) << e;
    EXPECT_GT(out.thinnest_P_mm.x, 0.1) << e;
    EXPECT_EQ(out.thin_share, 0.0) << e;
    EXPECT_NEAR(out.foramen_moved_mm, kB - kA + e, kLength_tolerance_mm) << e;
  }
}

TEST(CanalOutcomes, UntouchedIsTheShareOfTheWallThatTheHoleDoesNotReach) {
  const double e = 0.08;
  const CanalOutcomes out = outcomesOf(ShapeSolid(grid(), prepared(e)));
  const double due = 1.0 - std::acos((kA * kA + e * e - kB * kB) / (2.0 * kA * e)) / std::numbers::pi;
  EXPECT_NEAR(out.untouched, due, 0.015);
}

TEST(CanalOutcomes, WhereNothingWasCutNothingHasChanged) {
  const CanalOutcomes out = outcomesOf(before());
  EXPECT_EQ(out.removed_mm3, 0.0);
  EXPECT_EQ(out.untouched, 1.0);
  EXPECT_EQ(out.foramen_moved_mm, 0.0);
  EXPECT_EQ(out.schneider_before_rad, out.schneider_after_rad);
  for (const CanalSection& section : out.sections) {
    EXPECT_EQ(transportation_mm(section), 0.0);
    EXPECT_EQ(centring(section), 1.0);
  }
}

TEST(CanalOutcomes, ThinDentineIsTheShareBehindTheWall) {
  // A root of 0.6 mm around a canal of 0.15 has 0.45 everywhere.
  const auto root = [](const glm::dvec3& p) { return std::min(0.6 - aside(p), aside(p) - kA); };
  const ToothBlocks thin = blocksOf(grid(), root, [](const glm::dvec3& p) { return 0.6 - aside(p); });
  const CanalOutcomes out = shapes::outcomesAtOnce(thin, thin, canals(), 0, {1.0, 0.0, 0.0});
  EXPECT_EQ(out.thin_share, 1.0);
  EXPECT_NEAR(out.least_wall_mm, 0.45, 1.5 * kLength_tolerance_mm) << "the least of thousands of rays";
}

/// An arc between the same tangents with a larger radius: it starts (R' - R) tan(A/2) earlier.
assets::RootCanal bent(double arc_radius_mm, double radius_mm) {
  const double A = std::numbers::pi / 4.0, shift_mm = (arc_radius_mm - 5.0) * std::tan(0.5 * A);
  assets::RootCanal canal{6.0 - shift_mm, arc_radius_mm, A, 1.93 - shift_mm};
  canal.orifice_radius_mm = canal.apex_radius_mm = radius_mm;
  return canal;
}

TEST(CanalOutcomes, StraighteningIsTheDifferenceOfSchneidersAngles) {
  const assets::RootCanal was = bent(5.0, 0.12), is = bent(7.0, 0.45);
  assets::ToothCanal canal;
  for (int n = 0; n <= 60; ++n) {
    const double mm = was.length_mm() * n / 60.0;
    canal.places.push_back({was.at(mm).p_mm, mm, 0.12, 0.12});
  }
  const assets::VolumeGrid around = shapes::gridOf({-1.6, -1.6, -12.0}, {4.6, 1.6, 0.6}, 0.05);
  const ToothBlocks narrow = blocksOf(
      around, [&](const glm::dvec3& p) { return was.depth_mm(p); },
      [&](const glm::dvec3& p) { return 1.12 - glm::distance(p, was.at(was.nearest_mm(p)).p_mm); });
  const ShapeSolid wide(around, [&](const glm::dvec3& p) { return std::min(was.depth_mm(p), is.depth_mm(p)); });
  const CanalOutcomes out = shapes::outcomesAtOnce(narrow, wide, {canal}, 0, {1.0, 0.0, 0.0});
  EXPECT_NEAR(was.schneider_rad() * kDegrees, 30.0, 0.02);
  EXPECT_NEAR(out.schneider_before_rad * kDegrees, was.schneider_rad() * kDegrees, 0.5);
  EXPECT_NEAR(out.schneider_after_rad * kDegrees, is.schneider_rad() * kDegrees, 0.7);
}

TEST(CanalOutcomes, ThePlacesOfAFileTellItsLength) {
  TipTrack track(10.0);
  EXPECT_TRUE(track.isEmpty());
  for (const auto& [t_s, along_mm] : {std::pair(0.0, 9.0), {1.0, 10.3}, {1.5, 10.1}, {2.0, 9.8}})
    track.add(t_s, along_mm);
  const LengthError& error = track.error();
  EXPECT_NEAR(error.deepest_mm, 0.8, 1e-12);
  EXPECT_NEAR(error.at_rest_mm, 0.3, 1e-12);
  EXPECT_NEAR(error.most_over_mm, 0.3, 1e-12);
  EXPECT_NEAR(error.over_s, 1.0, 1e-12);
}

// #25 at full length: pi 16/12 (D0^2 + D0 D16 + D16^2).
TEST(CanalOutcomes, AnIsoFileSweepsItsFrustum) {
  const assets::VolumeGrid around = shapes::gridOf({-0.45, -0.45, -0.4}, {0.45, 0.45, 16.4}, 0.04);
  const ShapeSolid whole(around, [](const glm::dvec3&) { return 1.0; });
  const ShapeSolid swept(around, [](const glm::dvec3& p) {
    const double cone_mm = aside(p) - 0.5 * (0.25 + 0.02 * p.z);
    return std::max(cone_mm, std::max(-p.z, p.z - 16.0));
  });
  const double due_mm3 = std::numbers::pi * 16.0 / 12.0 * (0.25 * 0.25 + 0.25 * 0.57 + 0.57 * 0.57);
  EXPECT_NEAR(due_mm3, 2.2196, 1e-4);
  double removed_mm3 = 0.0;
  for (const glm::ivec3& block : changedBlocks(whole, swept))
    forRemoved(whole, swept, block, [&](glm::ivec3, double solid) { removed_mm3 += solid * around.voxelVolume_mm3(); });
  EXPECT_NEAR(removed_mm3, due_mm3, 0.005 * due_mm3);
}

TEST(CanalOutcomes, TheApicalFormOfAConeIsItsDiameterAndTaper) {
  const ShapeSolid cone(grid(), [](const glm::dvec3& p) {
    // 0.25 mm half a millimetre short of the foramen at z = -10.
    return std::min(rootWithCanal(p), aside(p) - 0.5 * (0.32 + 0.06 * (p.z + 9.5)));
  });
  const CanalOutcomes out = outcomesOf(cone);
  EXPECT_NEAR(out.apical_long_mm, 0.32, kLength_tolerance_mm);
  EXPECT_NEAR(out.apical_short_mm, 0.32, kLength_tolerance_mm);
  EXPECT_NEAR(out.taper, 0.06, 5e-4);
}

TEST(CanalOutcomes, ABuiltInMolarIsReadSparse) {
  const assets::BuiltInTooth built = assets::builtInTooth({}, 46);
  const assets::ToothCanals tooth = assets::canalsOf(built);
  const ToothBlocks blocks(*assets::fineBuiltInTooth(built, {}));
  EXPECT_LT(blocks.bytes(), 30e6);
  for (std::size_t c = 0; c < tooth.canals.size(); ++c) {
    const glm::dvec3 furcation_P = furcationSide_P(tooth, c);
    EXPECT_EQ(glm::dot(furcation_P, tooth.frame.axes_P[0]) > 0.0, c == 2) << "the mesial root's is distal";
    const CanalOutcomes out = shapes::outcomesAtOnce(blocks, blocks, tooth.canals, c, furcation_P);
    EXPECT_NEAR(out.schneider_before_rad * kDegrees, tooth.canals[c].schneider_rad * kDegrees, 1.5) << c;
    EXPECT_GT(out.least_wall_mm, kThinWall_mm) << c;
    EXPECT_LT(out.least_wall_mm, 1.0) << c;
    EXPECT_NEAR(out.apical_long_mm, 0.34, 0.02) << c;
    EXPECT_EQ(out.removed_mm3, 0.0);
  }
}

}  // namespace
}  // namespace app::round_root
