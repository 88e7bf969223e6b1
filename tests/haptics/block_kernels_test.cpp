#include "haptics/bone/block_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "assets/instruction_set.h"
#include "haptics/bone/lens_curve.h"
#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

TEST(LensCurve, IsTheLensOfTwoSpheresToAHundredThousandth) {
  for (double R : {4.0, 7.9, 8.0, 12.0, 20.0, 31.0, 32.0, 60.0, 120.0}) {
    const LensCurve curve(R);
    for (double t = 1e-4; t <= 2.0; t += 1e-3) {
      const double d = std::sqrt((curve.offset - t) / curve.scale);
      const Lens lens = lensOfSpheres(R, kVoxelSphereRadius, d);
      float volume = 0.0f, cap = 0.0f;
      for (int c = curve.coefficients - 1; c >= 0; --c) {
        volume = volume * static_cast<float>(t) + curve.volume[static_cast<std::size_t>(c)];
        cap = cap * static_cast<float>(t) + curve.cap[static_cast<std::size_t>(c)];
      }
      ASSERT_NEAR(t * t * volume, lens.volume, 1e-5) << R << ' ' << t;
      ASSERT_NEAR(t * t * cap, lens.moment / d, 2e-5) << R << ' ' << t;
    }
  }
}

struct Block {
  std::array<std::uint8_t, 64> solid{}, first{}, reach{}, after{};
  std::array<std::uint16_t, 64> coverage{}, dose{};
  std::array<std::uint32_t, 64> exposure{}, loss_q32{};

  BlockStep step(bool past, std::uint32_t turn) {
    return {solid.data(),
            coverage.data(),
            exposure.data(),
            loss_q32.data(),
            past ? first.data() : nullptr,
            reach.data(),
            dose.data(),
            77,
            turn,
            after.data(),
            {0, 0},
            0};
  }
};

Block randomBlock(std::mt19937& random) {
  Block block;
  for (std::size_t n = 0; n < 64; ++n) {
    block.first[n] = static_cast<std::uint8_t>(random());
    block.solid[n] = block.first[n];
    block.coverage[n] = static_cast<std::uint16_t>(random() % 3 == 0 ? 0 : random());
    block.exposure[n] = block.coverage[n] * static_cast<std::uint32_t>(random() % 3);
    block.loss_q32[n] = static_cast<std::uint32_t>(random()) >> random() % 32;
  }
  return block;
}

TEST(BlockKernels, AreTheSameToTheBitForEveryInstructionSet) {
#if defined(__x86_64__)
  if (!assets::available(assets::InstructionSet::avx2)) GTEST_SKIP() << "this machine has no AVX2";
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-45.0, 45.0);
  for (int trial = 0; trial < 500; ++trial) {
    const LensCurve curve(5.0 + trial % 40);
    BlockUnderBur at{{place(random), place(random), place(random)},
                     curve.scale,
                     curve.offset,
                     curve.coefficients,
                     {},
                     {0.6f, 0.0f, 0.8f},
                     trial % 2 == 0 ? 1.0f : 0.3f,
                     trial % 2 == 0 ? 0.0f : 0.02f};
    std::copy(curve.volume.begin(), curve.volume.end(), at.volume);
    Block one = randomBlock(random), other = one;
    portable::coverBlock(at, one.coverage.data(), one.exposure.data());
    avx2::coverBlock(at, other.coverage.data(), other.exposure.data());
    ASSERT_EQ(one.coverage, other.coverage);
    ASSERT_EQ(one.exposure, other.exposure);

    Block filled = randomBlock(random), twin = filled;
    for (std::uint32_t turn = 0; turn < 4; ++turn) {
      BlockStep a = filled.step(trial % 3 != 0, turn), b = twin.step(trial % 3 != 0, turn);
      ASSERT_EQ(portable::meetsBlock(a.solid, a.coverage), avx2::meetsBlock(b.solid, b.coverage));
      portable::stepBlock(a);
      avx2::stepBlock(b);
      ASSERT_EQ(filled.after, twin.after);
      ASSERT_EQ(filled.dose, twin.dose);
      ASSERT_EQ(filled.reach, twin.reach);
      ASSERT_EQ(a.removed, b.removed);
      ASSERT_EQ(a.digest_change.low, b.digest_change.low);
      ASSERT_EQ(a.digest_change.high, b.digest_change.high);
      filled.solid = filled.after, twin.solid = twin.after;
    }
  }
#endif
}

TEST(BlockKernels, ChangeTheDigestByWhatTheyChange) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 100; ++trial) {
    Block block = randomBlock(random);
    const BlockDigest before = blockDigest(block.solid.data(), block.reach.data(), block.dose.data());
    BlockStep step = block.step(true, 3);
    stepBlock(step);
    const BlockDigest after = blockDigest(block.after.data(), block.reach.data(), block.dose.data());
    EXPECT_EQ(after.low, before.low + step.digest_change.low);
    EXPECT_EQ(after.high, before.high + step.digest_change.high);
  }
}

}  // namespace
}  // namespace haptics
