#include "app/procedure/root_stress.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kRoot_mm = 3.5, kSpacing_mm = 0.25, kBoneTop_mm = 0.0;
constexpr glm::dvec3 kGrip_mm{0.0, 0.0, 9.0};

using Inside = std::function<bool(const glm::dvec3&)>;

bool isInRod(const glm::dvec3& p) { return std::hypot(p.x, p.y) < 0.5 * kRoot_mm; }

/// Upright from z = -8 to 10, of dentine, in bone up to z = 0.
HeldPiece heldPiece(const Inside& is_inside, bool in_bone = true) {
  HeldPiece piece;
  piece.grid = {glm::ivec3(64, 64, 96), kSpacing_mm, glm::dvec3(-8.0, -8.0, -12.0) + 0.5 * kSpacing_mm};
  const std::size_t voxels = piece.grid.voxelCount();
  piece.solid.assign(voxels, 0), piece.label.assign(voxels, 0), piece.jaw.assign(voxels, 0);
  assets::forVoxels(piece.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = piece.grid.centre_P_mm(ijk);
    const bool is_tooth = is_inside(p) && p.z > -8.0 && p.z < 10.0;
    if (is_tooth) piece.solid[v] = 255, piece.label[v] = static_cast<std::uint8_t>(assets::Tissue::dentine);
    if (in_bone && !is_tooth && p.z < kBoneTop_mm) piece.jaw[v] = 255;
  });
  return piece;
}

TEST(RootSections, OfARoundRootAreThoseOfTheTextbook) {
  const auto sections = rootSections(heldPiece(isInRod), kGrip_mm);
  ASSERT_EQ(sections.size(), kRootSections);
  const double area_mm2 = std::acos(-1.0) * kRoot_mm * kRoot_mm / 4.0;
  const double second_mm4 = std::acos(-1.0) * std::pow(kRoot_mm, 4) / 64.0;
  double former_held = 1.0;
  for (const RootSection& section : sections) {
    EXPECT_NEAR(section.area_mm2, area_mm2, 0.04 * area_mm2);
    EXPECT_NEAR(section.second_u_mm4, second_mm4, 0.08 * second_mm4);
    EXPECT_NEAR(section.second_v_mm4, second_mm4, 0.08 * second_mm4);
    for (const glm::dvec2& fibre : section.fibres_mm) EXPECT_NEAR(glm::length(fibre), 0.5 * kRoot_mm, 0.2);
    EXPECT_LE(section.held, former_held);
    former_held = section.held;
    if (section.centre_Q_mm.z > kBoneTop_mm + 1.0) {
      EXPECT_EQ(section.held, 1.0);
    }
  }
  EXPECT_LT(sections.back().held, 0.4);
}

TEST(RootSections, ABreakNeeds25NAcrossARoundRootAt10mm) {
  // reference/extraction 1.3: 253 N mm.
  for (const RootSection& section : rootSections(heldPiece(isInRod), kGrip_mm)) {
    if (section.held < 1.0) continue;
    const glm::dvec3 at_mm = section.centre_Q_mm + glm::dvec3(0.0, 0.0, 10.0);
    EXPECT_NEAR(stressAt_N_per_mm2(section, {25.0, 0.0, 0.0}, glm::dvec3(0.0), at_mm), 60.0, 6.0);
    EXPECT_NEAR(stressAt_N_per_mm2(section, glm::dvec3(0.0), {0.0, 253.0, 0.0}, at_mm), 60.0, 6.0);
    // 577 N straight; a push does not part it.
    EXPECT_NEAR(stressAt_N_per_mm2(section, {0.0, 0.0, 577.0}, glm::dvec3(0.0), at_mm), 60.0, 3.0);
    EXPECT_LT(stressAt_N_per_mm2(section, {0.0, 0.0, -577.0}, glm::dvec3(0.0), at_mm), 0.0);
  }
}

TEST(RootSections, TwoRootsBendEachAboutItsOwnMiddle) {
  const auto is_in_two = [](const glm::dvec3& p) {
    return p.z > 1.0 ? std::abs(p.x) < 5.0 && std::abs(p.y) < 2.5 : isInRod({std::abs(p.x) - 3.0, p.y, p.z});
  };
  const auto sections = rootSections(heldPiece(is_in_two), kGrip_mm);
  const double second_mm4 = std::acos(-1.0) * std::pow(kRoot_mm, 4) / 64.0;
  int seen = 0;
  for (const RootSection& section : sections) {
    if (section.centre_Q_mm.z > 0.5) continue;
    ++seen;
    EXPECT_NEAR(section.second_u_mm4, 2.0 * second_mm4, 0.2 * second_mm4);
    EXPECT_NEAR(section.second_v_mm4, 2.0 * second_mm4, 0.2 * second_mm4);
  }
  EXPECT_GE(seen, 3);
}

TEST(RootSections, EnamelCountsAThirdAndIsTheCrown) {
  HeldPiece piece = heldPiece(isInRod);
  assets::forVoxels(piece.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (piece.solid[v] > 0 && piece.grid.centre_P_mm(ijk).z > 4.0)
      piece.label[v] = static_cast<std::uint8_t>(assets::Tissue::enamel);
  });
  const auto sections = rootSections(piece, kGrip_mm);
  ASSERT_EQ(sections.size(), kRootSections);
  EXPECT_TRUE(sections.front().is_crown);
  EXPECT_FALSE(sections.back().is_crown);
  EXPECT_NEAR(sections.front().area_mm2, sections.back().area_mm2 / 3.0, 0.1);
}

TEST(RootSections, NothingIsBentThatNoBoneHolds) {
  EXPECT_TRUE(rootSections(heldPiece(isInRod, false), kGrip_mm).empty());
  HeldPiece lifted = heldPiece(isInRod);
  lifted.X_PQ.translation_mm = {0.0, 0.0, 9.5};
  EXPECT_TRUE(rootSections(lifted, kGrip_mm).empty());
}

/// The rod as the tooth of a jaw.
struct Patient {
  assets::Patient patient;
  std::vector<std::uint8_t> is_tooth;

  Patient() {
    const HeldPiece piece = heldPiece(isInRod);
    assets::CtVolume& ct = patient.ct;
    ct.grid = piece.grid;
    ct.solid = piece.jaw;
    ct.label = piece.label;
    is_tooth.assign(ct.solid.size(), 0);
    for (std::size_t v = 0; v < ct.solid.size(); ++v)
      if (piece.solid[v] > 0) ct.solid[v] = 255, is_tooth[v] = 1;
  }
};

TEST(RootStress, IsToldOnceAGripAndForgottenWithIt) {
  const Patient rod;
  const haptics::Bodies bodies(rod.patient.ct.grid, rod.patient.ct.solid, rod.patient.ct.label, rod.is_tooth);
  RootStress stress(rod.patient);
  haptics::Tick tick;
  tick.pieces = 1;
  tick.proxy_P.mm = kGrip_mm;
  stress.follow(tick, bodies);
  EXPECT_FALSE(stress.now_N_per_mm2());

  tick.gripped = 1;
  tick.grip_force_P_N.xyz = {5.0, 0.0, 0.0};
  stress.follow(tick, bodies);
  ASSERT_TRUE(stress.now_N_per_mm2());
  // Some 9 mm above the bone.
  EXPECT_NEAR(*stress.now_N_per_mm2(), 60.0 * 5.0 * 9.0 / 253.0, 2.5);
  EXPECT_FALSE(stress.news());

  tick.t_s = 0.1;
  tick.grip_force_P_N.xyz = {40.0, 0.0, 0.0};
  stress.follow(tick, bodies);
  EXPECT_GT(*stress.now_N_per_mm2(), RootStress::kBreaks_N_per_mm2);
  EXPECT_TRUE(stress.news());
  tick.t_s = 0.2;
  stress.follow(tick, bodies);
  EXPECT_FALSE(stress.news());

  tick.gripped = 0;
  stress.follow(tick, bodies);
  EXPECT_FALSE(stress.now_N_per_mm2());
  EXPECT_GT(stress.most_N_per_mm2(), RootStress::kBreaks_N_per_mm2);
  tick.gripped = 1;
  tick.t_s = 0.3;
  stress.follow(tick, bodies);
  EXPECT_TRUE(stress.news());
}

TEST(RootStress, TurnsWithThePiece) {
  const Patient rod;
  const haptics::Bodies bodies(rod.patient.ct.grid, rod.patient.ct.solid, rod.patient.ct.label, rod.is_tooth);
  haptics::Tick tick;
  tick.pieces = 1;
  tick.gripped = 1;
  tick.proxy_P.mm = kGrip_mm;
  tick.grip_force_P_N.xyz = {5.0, 3.0, 8.0};
  RootStress upright(rod.patient), turned(rod.patient);
  upright.follow(tick, bodies);
  const glm::dquat about_z = glm::angleAxis(0.5 * std::acos(-1.0), glm::dvec3(0.0, 0.0, 1.0));
  tick.X_PQ[0].rotation = about_z;
  tick.grip_force_P_N.xyz = about_z * tick.grip_force_P_N.xyz;
  turned.follow(tick, bodies);
  ASSERT_TRUE(upright.now_N_per_mm2() && turned.now_N_per_mm2());
  EXPECT_NEAR(*upright.now_N_per_mm2(), *turned.now_N_per_mm2(), 0.02 * *upright.now_N_per_mm2());
}

}  // namespace
}  // namespace app
