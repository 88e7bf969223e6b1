// What breaks a bridge, and what its break leaves: the table of the strength law, the share of a cube beside a plane,
// mass to the byte, a plane-by-plane twin, the spur of a thick bridge.
#include "haptics/body/bridge_break.h"

#include <numbers>
#include <random>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "haptics/body/bridge_strength.h"
#include "haptics/body/piece_split.h"
#include "haptics/body/tooth_survey.h"
#include "tests/haptics/tooth_phantom.h"

namespace haptics {
namespace {

using phantom::bridged;
using phantom::fill;
using phantom::ToothPhantom;

/// A rectangle as thick as `h`, 8 mm wide.
Bridge rectangle(double h_mm, double width_mm = 8.0) {
  Bridge bridge;
  bridge.area_mm2 = h_mm * width_mm;
  bridge.width_mm = width_mm, bridge.thickness_mm = h_mm;
  bridge.half_width_mm = 0.5 * width_mm, bridge.half_thickness_mm = 0.5 * h_mm;
  bridge.normal = {1.0, 0.0, 0.0};
  bridge.width_axis = {0.0, 1.0, 0.0};
  return bridge;
}

/// Of bridged(), cut straight across: the least area in voxels may lie along their faces.
Bridge acrossOf(Bridge bridge, double angle_rad) {
  bridge.normal = {std::sin(angle_rad), 0.0, std::cos(angle_rad)};
  bridge.width_axis = {0.0, 1.0, 0.0};
  return bridge;
}

/// The bridge that holds it, in single voxels.
Bridge bridgeOf(const ToothPhantom& whole, const ToothPhantom& now) {
  ToothSurvey survey(whole.grid, whole.solid);
  assets::forVoxels(glm::ivec3(0), now.grid.bricks(),
                    [&](glm::ivec3 brick) { survey.update(brick, phantom::brickOf(now, brick)); });
  ToothFindings found = survey.pieces();
  survey.findBridges(found, now.grid.spacing_mm);
  EXPECT_EQ(found.held[0].bridges, 1u);
  return found.held[0].bridge[0];
}

std::vector<std::uint8_t> bytesOf(const SplitPlan& plan, const assets::VolumeGrid& grid) {
  SolidField lattice;
  lattice.blocks = (grid.size + kBlockEdge - 1) / kBlockEdge;
  std::vector<std::uint8_t> bytes(grid.voxelCount(), 0);
  for (const SplitPlan::Block& block : plan.blocks)
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (lattice.blockAt(SolidField::blockOf(ijk)) == block.block) bytes[v] = block.given[SolidField::within(ijk)];
    });
  return bytes;
}

TEST(BridgeStrength, TableOfForcesAndTwistsToAPercent) {
  // From the formulas by hand: M/L of strength and of toughness, L = 1.6 + h/2.
  const std::array<double, 6> strength_N{34.8, 109.1, 199.5, 299.3, 404.1, 512.0};
  const std::array<double, 6> toughness_N{75.7, 172.97, 266.5, 353.3, 433.5, 508.0};
  const std::array<double, 6> twist_Nm{0.22, 0.51, 0.79, 1.04, 1.28, 1.52};
  for (int n = 0; n < 6; ++n) {
    const double h_mm = n + 1.0, force_N = std::max(strength_N[n], toughness_N[n]);
    EXPECT_NEAR(breakingForce_N(rectangle(h_mm), 0.0), force_N, 0.01 * force_N) << h_mm << " mm";
    EXPECT_NEAR(breakingTwist_Nmm(rectangle(h_mm), 0.0), 1000.0 * twist_Nm[n], 15.0) << h_mm << " mm";
  }
  EXPECT_NEAR(breakingForce_N(rectangle(2.0), 1.0), breakingForce_N(rectangle(2.0), 0.0) / 3.0, 1e-9) << "enamel";
}

TEST(BridgeStrength, AGeneralLoadNeedsStressAndToughness) {
  const Bridge bridge = rectangle(2.0);
  EXPECT_NEAR(shareOfBreaking(bridge, 0.0, wedgedBy(bridge, breakingForce_N(bridge, 0.0))), 1.0, 1e-12);
  // 79 b h^1.5 / 3.975 about the width; stress alone would break at 60 b h^2 / 6 = 320 N mm.
  EXPECT_NEAR(shareOfBreaking(bridge, 0.0, {0.0, -449.7, 0.0}), 1.0, 1e-3) << "either sense";
  // About the other axis 60 h b^2 / 6 = 1280 N mm starts it, 79 h b^1.5 / 3.975 = 899 N mm runs.
  EXPECT_NEAR(shareOfBreaking(bridge, 0.0, {0.0, 0.0, 1280.0}), 1.0, 1e-3);
  EXPECT_EQ(shareOfBreaking(bridge, 0.0, {1000.0, 0.0, 0.0}), 0.0) << "a pull without bending runs nowhere";
  EXPECT_LT(shareOfBreaking(bridge, 0.0, {-500.0, 0.0, 1280.0}), 1.0) << "pressed together";
  EXPECT_TRUE(std::isinf(shareOfBreaking({}, 0.0, {1.0, 1.0, 0.0})));
}

TEST(BridgeStrength, AVoxelBridgeBreaksLikeItsRectangle) {
  for (const double h_mm : {1.5, 2.4}) {
    const Bridge bridge = bridgeOf(bridged(0.15, 0.0, h_mm, 6.0, false), bridged(0.15, 0.0, h_mm, 6.0, true));
    const double expected_N = breakingForce_N(rectangle(h_mm, 6.0), 0.0);
    EXPECT_NEAR(breakingForce_N(bridge, 0.0), expected_N, 0.1 * expected_N) << h_mm << " mm";
    EXPECT_NEAR(bridge.half_thickness_mm, 0.5 * h_mm, 0.1);
    EXPECT_NEAR(bridge.half_width_mm, 3.0, 0.1);
  }
}

/// Many points in the cube.
TEST(BridgeBreak, ShareOfACubeBesideAPlane) {
  std::mt19937 rng(7);
  std::normal_distribution<double> any;
  std::uniform_real_distribution<double> offset(-0.9, 0.9);
  constexpr int kPoints = 40;
  for (int n = 0; n < 60; ++n) {
    glm::dvec3 normal = glm::normalize(glm::dvec3(any(rng), any(rng), any(rng)));
    if (n < 3) normal = {n == 0, n == 1, n == 2};
    const double distance = offset(rng);
    int below = 0;
    assets::forVoxels(glm::ivec3(0), glm::ivec3(kPoints), [&](glm::ivec3 at) {
      const glm::dvec3 p = (glm::dvec3(at) + 0.5) / static_cast<double>(kPoints) - 0.5;
      below += glm::dot(p, normal) <= distance ? 1 : 0;
    });
    EXPECT_NEAR(cubeShareBelow(normal, distance), below / std::pow(kPoints, 3), n < 3 ? 0.02 : 4e-3);
    EXPECT_NEAR(cubeShareBelow(normal, distance) + cubeShareBelow(-normal, -distance), 1.0, 1e-9);
  }
  EXPECT_NEAR(cubeShareBelow({0.0, 0.0, 1.0}, 0.5), 1.0, 1e-5);
  EXPECT_NEAR(cubeShareBelow({0.6, 0.8, 0.0}, 0.0), 0.5, 1e-9);
}

TEST(BridgeBreak, KeepsTheMassAndLeavesTwoPieces) {
  for (const double degrees : {0.0, 33.0, 45.0}) {
    const double angle_rad = degrees * std::numbers::pi / 180.0;
    const ToothPhantom now = bridged(0.3, angle_rad, 2.4, 6.0, true);
    const Bridge bridge = acrossOf(bridgeOf(bridged(0.3, angle_rad, 2.4, 6.0, false), now), angle_rad);
    const Components components(now.grid, now.solid);
    const auto plan = breakPlan(components, {}, bridge);
    ASSERT_TRUE(plan) << degrees;
    EXPECT_TRUE(plan->is_complete);
    const std::vector<std::uint8_t> off = bytesOf(plan->split, now.grid);
    std::vector<std::uint8_t> stays(off.size());
    long sum = 0, before = 0, shared = 0;
    for (std::size_t v = 0; v < off.size(); ++v) {
      ASSERT_LE(off[v], now.solid[v]);
      stays[v] = static_cast<std::uint8_t>(now.solid[v] - off[v]);
      sum += off[v] + stays[v];
      before += now.solid[v];
      shared += off[v] > 0 && stays[v] > 0 ? 1 : 0;
    }
    EXPECT_EQ(sum, before);
    EXPECT_GT(shared, degrees == 0.0 ? -1 : 40) << degrees;
    for (const auto& bytes : {off, stays}) {
      const Components side(now.grid, bytes);
      EXPECT_GT(side.pieces()[0].volume_mm3, 590.0);
      for (std::size_t n = 1; n < side.pieces().size(); ++n) EXPECT_LT(side.pieces()[n].volume_mm3, 0.5);
    }
    EXPECT_EQ(breakPlan(components, {}, bridge), plan) << "another time";
    // Other bytes, another digest.
    ToothPhantom other = now;
    fill(other, {40, 20, 12}, {41, 21, 13}, 0);
    const auto differs = breakPlan(Components(other.grid, other.solid), {}, bridge);
    ASSERT_TRUE(differs);
    EXPECT_EQ(differs->digest == plan->digest, other.solid == now.solid);
  }
}

/// Blocks above and below a plane: voxel by voxel, each by its own corner points.
TEST(BridgeBreak, TwinCutsEveryVoxelByThePlane) {
  const ToothPhantom now = bridged(0.3, 0.3, 2.4, 6.0, true);
  const Bridge bridge = acrossOf(bridgeOf(bridged(0.3, 0.3, 2.4, 6.0, false), now), 0.3);
  const auto plan = breakPlan(Components(now.grid, now.solid), {}, bridge);
  ASSERT_TRUE(plan);
  const std::vector<std::uint8_t> off = bytesOf(plan->split, now.grid);
  double off_side = 0.0;
  assets::forVoxels(now.grid, [&](glm::ivec3 ijk, std::size_t v) {
    off_side += off[v] * glm::dot(now.grid.centre_P_mm(ijk) - bridge.centre_mm, bridge.normal);
  });
  const double sign = off_side > 0.0 ? 1.0 : -1.0;
  int at_break = 0;
  assets::forVoxels(now.grid, [&](glm::ivec3 ijk, std::size_t v) {
    // Inside the bridge: everything near its axis.
    const glm::dvec3 from_centre = now.grid.centre_P_mm(ijk) - bridge.centre_mm;
    if (now.solid[v] != 255 || glm::length(from_centre) > 0.9) return;
    int within = 0;
    assets::forVoxels(glm::ivec3(0), glm::ivec3(20), [&](glm::ivec3 at) {
      const glm::dvec3 p = from_centre + 0.3 * ((glm::dvec3(at) + 0.5) / 20.0 - 0.5);
      within += sign * glm::dot(p, bridge.normal) > 0.0 ? 1 : 0;
    });
    EXPECT_NEAR(off[v], 255.0 * within / 8000.0, 4.0) << ijk.x << " " << ijk.y << " " << ijk.z;
    at_break += within > 0 && within < 8000 ? 1 : 0;
  });
  EXPECT_GT(at_break, 10);
}

/// A crown over a root, a slot from the buccal side (x above 0) that leaves `h_mm` on the lingual side.
struct Crowned {
  ToothPhantom whole{{50, 40, 84}, 0.25}, now = whole;
  std::vector<std::uint8_t> label;
  explicit Crowned(double h_mm) : label(whole.solid.size(), static_cast<std::uint8_t>(assets::Tissue::dentine)) {
    fill(whole, {5, 4, 4}, {45, 36, 80});
    now = whole;
    fill(now, {5 + static_cast<int>(std::lround(h_mm / 0.25)), 4, 28}, {45, 36, 34}, 0);
    assets::forVoxels(whole.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (ijk.z > 70) label[v] = static_cast<std::uint8_t>(assets::Tissue::enamel);
    });
  }
};

TEST(BridgeBreak, AThickBridgeLeavesASpurOnTheRoot) {
  for (const double h_mm : {2.5, 4.0, 7.0}) {
    const Crowned tooth(h_mm);
    const Bridge bridge = bridgeOf(tooth.whole, tooth.now);
    EXPECT_NEAR(bridge.thickness_mm, h_mm, 0.3);
    EXPECT_GT(bridge.floorwards().x, 0.99) << "the slot is buccal";
    const auto plan = breakPlan(Components(tooth.now.grid, tooth.now.solid), tooth.label, bridge);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->is_complete, h_mm < 3.0);
    EXPECT_EQ(plan->enamel_share, 0.0);
    const std::vector<std::uint8_t> off = bytesOf(plan->split, tooth.now.grid);
    // The height of the break above its floor, by how far it is inwards from the slot.
    const double slope = std::tan(h_mm < 3.0 ? 0.0 : std::min(45.0, 15.0 * (h_mm - 3.0)) * std::numbers::pi / 180.0);
    const int floor_i = 5 + static_cast<int>(std::lround(h_mm / 0.25));
    const bool crown_off = off[tooth.now.grid.index({20, 20, 75})] != 0;
    double lowest_mm = 0.0;
    for (int i = 5; i < floor_i; ++i) {
      double crown_mm = 0.0;
      for (int k = 4; k < 80; ++k) {
        const std::size_t v = tooth.now.grid.index({i, 20, k});
        crown_mm += 0.25 / 255.0 * (crown_off ? off[v] : tooth.now.solid[v] - off[v]);
      }
      const double inwards_mm = (floor_i - i - 0.5) * 0.25;
      const double base_mm = crown_mm + slope * inwards_mm;
      if (i == 5) lowest_mm = base_mm;
      EXPECT_NEAR(base_mm, lowest_mm, 0.02) << h_mm << " mm, column " << i;
    }
  }
}

TEST(BridgeBreak, EnamelOfTheBreakCounts) {
  Crowned tooth(2.0);
  std::ranges::fill(tooth.label, static_cast<std::uint8_t>(assets::Tissue::enamel));
  const auto plan =
      breakPlan(Components(tooth.now.grid, tooth.now.solid), tooth.label, bridgeOf(tooth.whole, tooth.now));
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->enamel_share, 1.0);
}

/// A bump on the wall of the slot that the plane cuts off stays where it is.
TEST(BridgeBreak, ACrumbStaysWithWhatItGrowsOn) {
  Crowned tooth(2.0);
  fill(tooth.now, {14, 18, 28}, {16, 20, 32});
  const Bridge bridge = bridgeOf(tooth.whole, tooth.now);
  const auto plan = breakPlan(Components(tooth.now.grid, tooth.now.solid), tooth.label, bridge);
  ASSERT_TRUE(plan);
  const std::vector<std::uint8_t> off = bytesOf(plan->split, tooth.now.grid);
  const std::uint8_t below = off[tooth.now.grid.index({14, 18, 20})];
  for (int k = 28; k < 32; ++k) EXPECT_EQ(off[tooth.now.grid.index({15, 19, k})], below) << k;
}

TEST(BridgeBreak, NoPlanForWhatIsNoBridge) {
  const Crowned tooth(2.0);
  const Components components(tooth.now.grid, tooth.now.solid);
  const Bridge bridge = bridgeOf(tooth.whole, tooth.now);
  EXPECT_TRUE(breakPlan(components, {}, bridge));
  Bridge bad = bridge;
  bad.centre_mm.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(breakPlan(components, {}, bad));
  bad = bridge, bad.normal *= 2.0;
  EXPECT_FALSE(breakPlan(components, {}, bad));
  bad = bridge, bad.width_axis = bad.normal;
  EXPECT_FALSE(breakPlan(components, {}, bad));
  // Beside the tooth.
  bad = bridge, bad.centre_mm.z += 30.0;
  EXPECT_FALSE(breakPlan(components, {}, bad));
  // In two pieces already.
  EXPECT_FALSE(breakPlan(Components(tooth.now.grid, Crowned(0.0).now.solid), {}, bridge));
}

}  // namespace
}  // namespace haptics
