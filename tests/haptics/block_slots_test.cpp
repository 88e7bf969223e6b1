// What is felt does not depend on where a block lies in memory: to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "haptics/contact/field_sample.h"
#include "haptics/contact/law.h"
#include "haptics/contact/overlap.h"
#include "tests/haptics/phantom.h"
#include "tests/haptics/shuffled_blocks.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Pose;
using calibration::Tool;

/// Grey bone with holes of several blocks, and labels that differ within blocks here and there.
CarvedBone spongyBone(std::mt19937& random) {
  Phantom bone = filled(4.0, 0.2, [](const glm::dvec3& p) {
    return std::sin(2.1 * p.x) + std::sin(1.7 * p.y) + std::sin(1.9 * p.z) - 0.6;
  });
  std::vector<std::uint8_t> label(bone.solid.size());
  assets::forVoxels(bone.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (random() % 3 == 0 && bone.solid[v] > 4) bone.solid[v] = static_cast<std::uint8_t>(bone.solid[v] - random() % 5);
    label[v] = static_cast<std::uint8_t>(ijk.x / 11 + 2 * (ijk.y / 13));
  });
  return CarvedBone(bone.grid, bone.solid, label);
}

glm::dvec3 anywhere(std::mt19937& random, double far_mm) {
  std::uniform_real_distribution<double> place(-far_mm, far_mm);
  return {place(random), place(random), place(random)};
}

bool isSame(const Contact& a, const Contact& b) {
  return std::memcmp(&a.force_P_N, &b.force_P_N, sizeof a.force_P_N) == 0 &&
         std::memcmp(&a.torque_P_Nmm, &b.torque_P_Nmm, sizeof a.torque_P_Nmm) == 0 && a.depth_mm == b.depth_mm &&
         a.volume_mm3 == b.volume_mm3 && a.tissue_factor == b.tissue_factor;
}

TEST(BlockSlots, GiveTheSameForceWhereverABlockLies) {
  std::mt19937 random(11);
  const CarvedBone bone = spongyBone(random);
  const ShuffledBlocks shuffled(bone.field(), 12);
  int felt = 0;
  for (int trial = 0; trial < 600; ++trial) {
    LawSettings law;
    law.kind = static_cast<LawKind>(random() % kLaws.size());
    const bool is_round = trial % 2 == 0;
    const BurShape head{is_round ? ShapeKind::sphere : static_cast<ShapeKind>(random() % 4),
                        0.3 + 0.002 * static_cast<double>(random() % 1000), is_round ? 0.0 : 2.0};
    const Pose<Patient, Tool> X_PT{glm::normalize(glm::dquat(1.0, anywhere(random, 1.0))), anywhere(random, 4.5)};
    const ToolMotion motion{{anywhere(random, 5.0)}, 100.0, 1e-3, 0.0};
    const Contact one = contactOf(law, {bone.field(), head, X_PT, law.tissue, motion});
    const Contact other = contactOf(law, {shuffled.field(), head, X_PT, law.tissue, motion});
    ASSERT_TRUE(isSame(one, other)) << trial << ", law " << kLaws[static_cast<std::size_t>(law.kind)].key;
    felt += one.volume_mm3 > 0.0 ? 1 : 0;
  }
  EXPECT_GT(felt, 300);
}

TEST(BlockSlots, GiveTheSameSumsByEveryInstructionSet) {
  std::mt19937 random(13);
  const CarvedBone bone = spongyBone(random);
  const ShuffledBlocks shuffled(bone.field(), 14);
  const TissueStiffness tissue;
  for (const auto set :
       {assets::InstructionSet::portable, assets::InstructionSet::avx2, assets::InstructionSet::avx512})
    for (int trial = 0; trial < 200 && assets::available(set); ++trial) {
      const double radius_mm = 0.7 + 0.003 * static_cast<double>(random() % 1000);
      const calibration::Point<Patient> centre{anywhere(random, 4.5)};
      const SphereOverlap one = sphereOverlap(bone.field(), centre, radius_mm, &tissue, set);
      const SphereOverlap other = sphereOverlap(shuffled.field(), centre, radius_mm, &tissue, set);
      ASSERT_EQ(std::memcmp(&one, &other, sizeof one), 0);
    }
}

TEST(BlockSlots, GiveTheSameSamples) {
  std::mt19937 random(15);
  const CarvedBone bone = spongyBone(random);
  const ShuffledBlocks shuffled(bone.field(), 16);
  const ToolSampler one(bone.field(), {}), other(shuffled.field(), {});
  for (int trial = 0; trial < 20000; ++trial) {
    const glm::dvec3 p = anywhere(random, 4.3);
    const FieldSample a = one.at(p), b = other.at(p);
    ASSERT_EQ(a.solid, b.solid);
    ASSERT_EQ(a.label, b.label);
  }
}

}  // namespace
}  // namespace haptics
