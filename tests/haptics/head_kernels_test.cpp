#include "haptics/bone/head_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <optional>
#include <random>

#include "assets/instruction_set.h"
#include "haptics/bone/bur_coverage.h"

namespace haptics {
namespace {

/// A block somewhere about a head, with random bone.
class Scene {
 public:
  explicit Scene(unsigned seed) : random_(seed) {
    const auto number = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random_);
    };
    const assets::VolumeGrid grid{{64, 64, 64}, 1.0, {}};
    BurShape shape{static_cast<ShapeKind>(seed % kShapeKinds), number(3.0, 12.0), number(4.0, 30.0)};
    if (shape.kind == ShapeKind::revolved) {
      shape.profile = static_cast<assets::BurProfile>(seed / kShapeKinds % assets::kBurProfiles);
      shape.length_mm = std::max(shape.length_mm, assets::leastBurLength_mm(shape.profile, shape.radius_mm));
    }
    const glm::dquat turn = glm::normalize(glm::dquat(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)));
    bur.emplace(grid, shape, calibration::Pose<calibration::Patient, calibration::Tool>{turn, {31.3, 32.1, 30.7}});
    head = bur->kernelShape();
    for (int axis = 0; axis < 3; ++axis) corner[axis] = 4 * static_cast<int>(number(4.0, 12.0));
    const glm::dvec3 place = bur->positionInTool(corner);
    for (std::size_t n = 0; n < 64; ++n) {
      solid[n] = static_cast<std::uint8_t>(number(0.0, 255.9));
      factor[n] = static_cast<float>(number(0.1, 1.5));
      for (auto& axis : rise) axis[n] = static_cast<std::int16_t>(number(-255.0, 255.0));
    }
    block = {{static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)},
             solid.data(),
             {rise[0].data(), rise[1].data(), rise[2].data()},
             seed % 3 == 0 ? nullptr : factor.data(),
             0.7f};
  }

  std::optional<BurCoverage> bur;
  HeadShape head;
  glm::ivec3 corner{0};
  std::array<std::uint8_t, 64> solid;
  std::array<float, 64> factor;
  std::array<std::array<std::int16_t, 64>, 3> rise;
  HeadBlock block;

 private:
  std::mt19937 random_;
};

TEST(HeadKernels, CoverWhatBurCoverageCovers) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Scene scene(seed);
    std::array<float, 64> fraction;
    coverUnderHead(scene.head, scene.block.first, fraction.data());
    for (int n = 0; n < 64; ++n) {
      const double slow = scene.bur->shareAt(scene.corner + glm::ivec3(n & 3, n >> 2 & 3, n >> 4)).fraction;
      EXPECT_NEAR(fraction[static_cast<std::size_t>(n)], slow, 2e-5) << seed;
    }
  }
}

TEST(HeadKernels, GiveTheSameBitsFromEveryInstructionSet) {
#if defined(__x86_64__)
  const auto same = [](const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Scene scene(seed);
    const HeadSums portable_sums = portable::sumUnderHead(scene.head, scene.block);
    std::array<float, 64> portable_part, part;
    portable::coverUnderHead(scene.head, scene.block.first, portable_part.data());
    if (assets::available(assets::InstructionSet::avx2)) {
      EXPECT_TRUE(same(avx2::sumUnderHead(scene.head, scene.block), portable_sums)) << seed;
      avx2::coverUnderHead(scene.head, scene.block.first, part.data());
      EXPECT_TRUE(same(part, portable_part)) << seed;
    }
    if (assets::available(assets::InstructionSet::avx512)) {
      EXPECT_TRUE(same(avx512::sumUnderHead(scene.head, scene.block), portable_sums)) << seed;
      avx512::coverUnderHead(scene.head, scene.block.first, part.data());
      EXPECT_TRUE(same(part, portable_part)) << seed;
    }
  }
#endif
}

}  // namespace
}  // namespace haptics
