// Where a root may break, and what breaks it: closed forms of round and elliptic beams.
#include "haptics/body/root_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "haptics/body/bridge_strength.h"

namespace haptics {
namespace {

struct Solid {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid, label;

  /// `inside_mm`: below 0 inside.
  Solid(double voxel_mm, const std::function<double(const glm::dvec3&)>& inside_mm)
      : grid{glm::ivec3(static_cast<int>(12.0 / voxel_mm), static_cast<int>(12.0 / voxel_mm),
                        static_cast<int>(18.0 / voxel_mm)),
             voxel_mm, glm::dvec3(-6.0, -6.0, -9.0) + 0.5 * voxel_mm},
        solid(grid.voxelCount()),
        label(grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::dentine)) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const double share = std::clamp(0.5 - inside_mm(grid.centre_P_mm(ijk)) / voxel_mm, 0.0, 1.0);
      solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * share));
    });
  }
  RootSections sections() const { return rootSections(grid, solid, label); }
};

/// A rod along z with an elliptic section.
Solid rod(double a_mm, double b_mm) {
  return {0.2, [=](const glm::dvec3& p) {
            const double scale = std::hypot(p.x / a_mm, p.y / b_mm);
            return std::max((scale - 1.0) * std::min(a_mm, b_mm), std::abs(p.z) - 7.0);
          }};
}

double momentOfBreaking_Nmm(const RootSection& root, bool about_width) {
  const BridgeLoad one{0.0, about_width ? 1.0 : 0.0, about_width ? 0.0 : 1.0};
  return 1.0 / shareOfBreakingRoot(root.section, root.enamel_share, one);
}

TEST(RootSection, ARoundRootOfThreeAndAHalfBreaksAt253NewtonMillimetres) {
  const RootSections found = rod(1.75, 1.75).sections();
  // What leaves less than a quarter is no tip.
  ASSERT_EQ(found.sections.size(), static_cast<std::size_t>(kRootLevels) - 2);
  for (const RootSection& root : found.sections) {
    EXPECT_NEAR(root.section.area_mm2, std::numbers::pi * 1.75 * 1.75, 0.3);
    EXPECT_NEAR(momentOfBreaking_Nmm(root, true), 253.0, 15.0);
    EXPECT_NEAR(momentOfBreaking_Nmm(root, false), 253.0, 15.0);
    EXPECT_NEAR(1.0 / shareOfBreakingRoot(root.section, 0.0, {1.0, 0.0, 0.0}), 60.0 * root.section.area_mm2, 1e-6);
    EXPECT_EQ(shareOfBreakingRoot(root.section, 0.0, {-100.0, 0.0, 0.0}), 0.0) << "pressed, it holds";
  }
}

TEST(RootSection, AFlatRootIsStrongerAcrossItsWidth) {
  // Section modulus of an ellipse: pi a b^2 / 4.
  const RootSections found = rod(3.0, 1.5).sections();
  ASSERT_FALSE(found.sections.empty());
  const RootSection& root = found.sections[3];
  EXPECT_GT(std::abs(root.section.width_axis.x), 0.99);
  EXPECT_NEAR(momentOfBreaking_Nmm(root, true), 60.0 * std::numbers::pi * 3.0 * 1.5 * 1.5 / 4.0, 25.0);
  EXPECT_NEAR(momentOfBreaking_Nmm(root, false), 60.0 * std::numbers::pi * 1.5 * 3.0 * 3.0 / 4.0, 50.0);
}

TEST(RootSection, ObliqueBendingOfARoundRootIsAsStraight) {
  const RootSections found = rod(1.75, 1.75).sections();
  const Bridge& section = found.sections[0].section;
  const double part = 100.0 / std::sqrt(2.0);
  EXPECT_NEAR(shareOfBreakingRoot(section, 0.0, {0.0, part, part}),
              shareOfBreakingRoot(section, 0.0, {0.0, 100.0, 0.0}), 0.02);
}

/// A crown of enamel above z = 2, two roots below.
Solid molar() {
  Solid one(0.25, [](const glm::dvec3& p) {
    if (p.z > -1.0) return std::max({std::hypot(p.x, p.y) - 4.5, p.z - 7.0});
    return std::max(std::hypot(std::abs(p.x) - 2.6, p.y) - 1.6, -8.0 - p.z);
  });
  assets::forVoxels(one.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (one.grid.centre_P_mm(ijk).z > 2.0) one.label[v] = static_cast<std::uint8_t>(assets::Tissue::enamel);
  });
  return one;
}

TEST(RootSection, EachRootBelowTheForkHasItsOwnAndTheCrownOneOfBoth) {
  const Solid tooth = molar();
  const RootSections found = tooth.sections();
  int of_roots = 0, of_crown = 0;
  for (const RootSection& root : found.sections) {
    EXPECT_LT(root.section.normal.z, -0.99) << "to the tips";
    if (root.section.centre_mm.z > -1.0) {
      ++of_crown;
      EXPECT_GT(root.section.area_mm2, 50.0);
      continue;
    }
    ++of_roots;
    EXPECT_NEAR(root.section.area_mm2, std::numbers::pi * 1.6 * 1.6, 0.5);
    EXPECT_NEAR(std::abs(root.section.centre_mm.x), 2.6, 0.15);
    EXPECT_NEAR(root.beyond_mm3, root.section.area_mm2 * (root.section.centre_mm.z + 8.0), 3.0);
  }
  EXPECT_GE(of_roots, 6);
  EXPECT_EQ(of_roots % 2, 0);
  EXPECT_GE(of_crown, 2);
}

TEST(RootSection, WhatComesOffIsWhatLiesBeyondAndNoMoreThanThereIs) {
  const Solid tooth = molar();
  const RootSections found = tooth.sections();
  ASSERT_FALSE(found.sections.empty());
  SolidField lattice;
  lattice.blocks = (tooth.grid.size + kBlockEdge - 1) / kBlockEdge;
  for (std::size_t n = 0; n < found.sections.size(); ++n) {
    const RootSection& root = found.sections[n];
    std::vector<std::uint8_t> given(tooth.solid.size(), 0);
    assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const std::size_t at = lattice.offsetOf(ijk);
      for (const SplitPlan::Block& block : root.split.blocks)
        if (block.block == at / kBlockVoxels) given[v] = block.given[at % kBlockVoxels];
    });
    double given_mm3 = 0.0;
    assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
      ASSERT_LE(given[v], tooth.solid[v]);
      given_mm3 += given[v] / 255.0 * tooth.grid.voxelVolume_mm3();
      const double beyond_mm = glm::dot(tooth.grid.centre_P_mm(ijk) - root.section.centre_mm, root.section.normal);
      const bool is_beyond = (found.beyond[v] >> n & 1U) != 0 && beyond_mm > tooth.grid.spacing_mm;
      EXPECT_TRUE(given[v] == 0 || beyond_mm > -tooth.grid.spacing_mm);
      EXPECT_TRUE(!is_beyond || given[v] == tooth.solid[v]);
    });
    EXPECT_NEAR(given_mm3, root.beyond_mm3, 0.08 * root.beyond_mm3);
  }
}

TEST(RootSection, EnamelCountsAThirdAndNothingHasNoSection) {
  const RootSections found = rod(1.75, 1.75).sections();
  const BridgeLoad load{0.0, 100.0, 0.0};
  EXPECT_NEAR(shareOfBreakingRoot(found.sections[0].section, 1.0, load),
              3.0 * shareOfBreakingRoot(found.sections[0].section, 0.0, load), 1e-9);
  EXPECT_TRUE(Solid(0.5, [](const glm::dvec3&) { return 1e3; }).sections().sections.empty());
}

}  // namespace
}  // namespace haptics
