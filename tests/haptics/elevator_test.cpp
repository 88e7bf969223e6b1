#include "haptics/ligament/elevator_hold.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/haptics/elevator_scene.h"

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3;
/// Of the core of a straight 301: between the balls along its edges.
constexpr double kCoreWidth_mm = 2.7, kCoreTip_mm = 0.2, kCoreRoot_mm = 0.7;

ElevatorLaw smoothLaw() {
  ElevatorLaw law;
  law.friction = 0.0;
  return law;
}

/// Two walls across y, up to z; nothing above.
DistanceField slotField(double gap_mm, double top_mm) {
  return phantom::fieldWhere({60, 60, 70}, 0.2,
                             [=](const glm::dvec3& p) { return std::max(gap_mm / 2.0 - std::abs(p.y), p.z - top_mm); });
}

TEST(Elevator, IsAWheelAndAxleBetweenTwoWalls) {
  const DistanceField walls = slotField(2.0, 3.0);
  const ElevatorScene scene{.obstacles = &walls};
  ElevatorHold hold(ElevatorKind::straight_301, smoothLaw());
  ASSERT_TRUE(hold.take(ElevatorKind::straight_301, phantom::bladeAt({0.0, 0.0, -5.5})));
  ElevatorHand hand{.X_PT = phantom::bladeAt({0.0, 0.0, -5.5})};
  int pressed = 0;
  for (int n = 0; n < 1200; ++n) {
    hand.X_PT.rotation = phantom::twisted(0.8 * n / 1200.0);
    const ElevatorTick tick = hold.step(hand, scene, nullptr, kTick_s);
    EXPECT_FALSE(tick.unsettled);
    if (tick.twist_Nmm < 100.0) continue;
    ++pressed;
    const double phi = phantom::twistOf(tick.X_PT), depth_mm = tick.fulcrum_P_mm.z - tick.X_PT.translation_mm.z;
    const double t_mm = kCoreTip_mm + (kCoreRoot_mm - kCoreTip_mm) * (depth_mm - 0.15) / 7.7;
    const double force_N = tick.twist_Nmm / (kCoreWidth_mm * std::cos(phi) - t_mm * std::sin(phi));
    EXPECT_NEAR(tick.blade_on_bone_N / (2.0 * force_N), 1.0, 0.01) << phi;
    EXPECT_LT(glm::length(tick.on_hand.force_N.xyz), 0.02 * force_N) << "a couple";
  }
  EXPECT_GT(pressed, 300);
}

}  // namespace
}  // namespace haptics
