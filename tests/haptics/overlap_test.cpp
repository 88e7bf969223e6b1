#include "haptics/contact/overlap.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "haptics/contact/cap.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

void expectSame(const SphereOverlap& fast, const SphereOverlap& slow, double scale) {
  EXPECT_NEAR(fast.volume_mm3, slow.volume_mm3, 2e-6 * scale);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(fast.first_moment_P_mm4.xyz[axis], slow.first_moment_P_mm4.xyz[axis], 2e-6 * scale);
}

TEST(Overlap, EqualsTheSumVoxelByVoxelInRandomBone) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255);
  Phantom phantom = block(5.0, 0.25);
  for (auto& solid : phantom.solid) solid = static_cast<std::uint8_t>(byte(random) < 128 ? 0 : byte(random));
  std::uniform_real_distribution<double> place(-7.0, 7.0), radius(0.05, 4.5);
  for (int trial = 0; trial < 300; ++trial) {
    const Point<Patient> centre{{place(random), place(random), place(random)}};
    const double R = radius(random);
    expectSame(sphereOverlap(phantom.field(), centre, R), sphereOverlapVoxelByVoxel(phantom.field(), centre, R),
               R * R * R * (1.0 + R));
  }
}

TEST(Overlap, EqualsTheSumVoxelByVoxelInLongSolidRows) {
  const Phantom phantom = block(10.0, 0.1);
  for (double R : {3.3, 9.0, 14.0}) {
    const Point<Patient> centre{{0.037, -0.021, 0.44}};
    expectSame(sphereOverlap(phantom.field(), centre, R), sphereOverlapVoxelByVoxel(phantom.field(), centre, R),
               R * R * R * (1.0 + R));
  }
}

/// A block of bone whose labels change inside it, on and off the borders of the blocks of memory.
Cubelets labelledBone() {
  std::mt19937 random(11);
  const Phantom phantom = block(4.0, 0.2);
  std::vector<std::uint8_t> solid(phantom.solid), label(phantom.solid.size());
  for (int k = 0; k < phantom.grid.size.z; ++k)
    for (int j = 0; j < phantom.grid.size.y; ++j)
      for (int i = 0; i < phantom.grid.size.x; ++i) {
        const std::size_t voxel = phantom.grid.index({i, j, k});
        label[voxel] = static_cast<std::uint8_t>(i < 17 ? 4 : k < 20 ? 2 : 250);
        if (j > 30) solid[voxel] = static_cast<std::uint8_t>(random() % 256);
      }
  return Cubelets(phantom.grid, solid, label);
}

TEST(Overlap, IsTheSameByEveryInstructionSet) {
  const Cubelets bone = labelledBone();
  const TissueStiffness tissue;
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-5.0, 5.0), radius(0.3, 3.8);
  for (int trial = 0; trial < 200; ++trial) {
    const Point<Patient> centre{{place(random), place(random), place(random)}};
    const double R = radius(random), scale = R * R * R * (1.0 + R);
    const SphereOverlap slow = sphereOverlapVoxelByVoxel(bone.field(), centre, R, &tissue);
    SphereOverlap by[3];
    for (assets::InstructionSet set :
         {assets::InstructionSet::portable, assets::InstructionSet::avx2, assets::InstructionSet::avx512}) {
      if (!assets::available(set)) continue;
      const SphereOverlap fast = sphereOverlap(bone.field(), centre, R, &tissue, set);
      expectSame(fast, slow, scale);
      EXPECT_NEAR(fast.grey_mm3, slow.grey_mm3, 2e-6 * scale);
      EXPECT_NEAR(fast.stiff_mm3, slow.stiff_mm3, 2e-5 * slow.stiff_mm3 + 2e-6 * scale);
      by[static_cast<int>(set)] = fast;
    }
    if (assets::available(assets::InstructionSet::avx512)) {
      EXPECT_EQ(by[1].volume_mm3, by[2].volume_mm3);
      EXPECT_EQ(by[1].first_moment_P_mm4.xyz, by[2].first_moment_P_mm4.xyz);
      EXPECT_EQ(by[1].stiff_mm3, by[2].stiff_mm3);
    }
  }
}

TEST(Overlap, IsNothingAHairOutsideTheBone) {
  const Phantom phantom = halfSpace(3.0, 0.1);  // the last voxel that holds anything is centred 0.05 mm over the face
  for (double R : {0.4, 1.0, 2.0})
    EXPECT_EQ(sphereOverlap(phantom.field(), {{0.0, 0.0, R + 0.113}}, R).volume_mm3, 0.0);
}

TEST(Overlap, IsTheBallInsideSolidBone) {
  const Phantom phantom = block(4.0, 0.1);
  const SphereOverlap overlap = sphereOverlap(phantom.field(), {{0.013, 0.05, -0.02}}, 2.0);
  EXPECT_NEAR(overlap.volume_mm3, capVolume_mm3(2.0, 4.0), 1e-3 * overlap.volume_mm3);
  EXPECT_LT(glm::length(overlap.first_moment_P_mm4.xyz), 1e-3 * capMoment_mm4(2.0, 2.0));
}

TEST(Overlap, HasTheCapsVolumeAndBiasOnAFlatFace) {
  // Mean over lattice phases: the cap and 0.504 s^2 (R - h), reference/physics 0.6.
  const double R = 2.0;
  for (double s : {0.1, 0.2})
    for (double h : {0.2, 1.0, 2.0}) {
      double extra = -capVolume_mm3(R, h);
      constexpr int kPhases = 8;
      for (int phase = 0; phase < kPhases; ++phase) {
        const Phantom phantom = halfSpace(3.0, s, {0.0, 0.0, 1.0}, glm::dvec3(0.3, 0.7, (phase + 0.5) / kPhases) * s);
        extra += sphereOverlap(phantom.field(), {{0.0, 0.0, R - h}}, R).volume_mm3 / kPhases;
      }
      EXPECT_NEAR(extra, 0.504 * s * s * (R - h), 0.05 * 0.504 * s * s * (R - h) + 0.001 * capVolume_mm3(R, h));
    }
}

TEST(Overlap, HasTheCapsMoment) {
  const Phantom phantom = halfSpace(3.0, 0.1);
  const SphereOverlap overlap = sphereOverlap(phantom.field(), {{0.01, 0.02, 1.0}}, 2.0);
  EXPECT_NEAR(overlap.first_moment_P_mm4.xyz.z, -capMoment_mm4(2.0, 1.0), 2e-3 * capMoment_mm4(2.0, 1.0));
}

TEST(Overlap, TakesOutsideTheVolumeForAir) {
  const Phantom phantom = block(2.0, 0.1);
  EXPECT_EQ(sphereOverlap(phantom.field(), {{0.0, 0.0, 50.0}}, 2.0).volume_mm3, 0.0);
  EXPECT_NEAR(sphereOverlap(phantom.field(), {{0.0, 0.0, 2.0}}, 1.0).volume_mm3, capVolume_mm3(1.0, 1.0), 0.01);
}

TEST(Overlap, AnswersNothingForWhatIsNoBall) {
  const Phantom phantom = block(2.0, 0.2);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sphereOverlap(phantom.field(), {{nan, 0.0, 0.0}}, 1.0).volume_mm3, 0.0);
  EXPECT_EQ(sphereOverlap(phantom.field(), {{0.0, inf, 0.0}}, 1.0).volume_mm3, 0.0);
  EXPECT_EQ(sphereOverlap(phantom.field(), {{0.0, 0.0, 1e300}}, 1.0).volume_mm3, 0.0);
  EXPECT_EQ(sphereOverlap(phantom.field(), {{0.0, 0.0, 0.0}}, nan).volume_mm3, 0.0);
  EXPECT_EQ(sphereOverlap(phantom.field(), {{0.0, 0.0, 0.0}}, -1.0).volume_mm3, 0.0);
  EXPECT_EQ(sphereOverlap(phantom.field(), {{0.0, 0.0, 0.0}}, inf).volume_mm3, 0.0);
}

TEST(DominantLabel, IsTheTissueThatFillsMostOfTheBur) {
  const Phantom phantom = block(3.0, 0.1);
  std::vector<std::uint8_t> label(phantom.solid.size(), 1);
  for (int k = 0; k < phantom.grid.size.z / 2; ++k)
    for (int j = 0; j < phantom.grid.size.y; ++j)
      for (int i = 0; i < phantom.grid.size.x; ++i) label[phantom.grid.index({i, j, k})] = 4;
  const Cubelets cubelets(phantom.grid, phantom.solid, label);
  const SolidField field = cubelets.field();
  EXPECT_EQ(dominantLabel(field, {{0.0, 0.0, 0.5}}, 1.0), 1);
  EXPECT_EQ(dominantLabel(field, {{0.0, 0.0, -0.5}}, 1.0), 4);
  EXPECT_EQ(dominantLabel(field, {{0.0, 0.0, 50.0}}, 1.0), 0);
}

}  // namespace
}  // namespace haptics
