#include "haptics/device/simulated/led_hand.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3;

/// Along x at 10 mm/s with the pedal down.
LedPath tenMillimetres() {
  return {[](double t_s) {
            return HandTarget{{10.0 * std::min(t_s, 1.0), 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, t_s < 1.0, 0, true};
          },
          1.0};
}

HandleState after(LedHand& hand, double seconds, double wall_at_mm = 1e9) {
  HandleState state;
  double x_mm = 0.0;
  for (double t_s = 0.0; t_s < seconds; t_s += kTick_s) {
    Wrench<calibration::Device> push{};
    push.force_N.xyz.x = x_mm > wall_at_mm ? -10.0 * (x_mm - wall_at_mm) : 0.0;
    state = hand.exchange(push, kTick_s);
    x_mm = state.X_DH.translation_mm.x;
  }
  return state;
}

TEST(LedHand, RestsUntilItIsLed) {
  LedHand hand(HandTarget{{3.0, 2.0, 1.0}, {1.0, 0.0, 0.0, 0.0}, true, 0, true});
  const HandleState state = after(hand, 0.5);
  EXPECT_EQ(state.X_DH.translation_mm, glm::dvec3(3.0, 2.0, 1.0));
  EXPECT_FALSE(state.pedal);
}

TEST(LedHand, GoesAlongItsPathAndArrives) {
  LedHand hand({});
  const LedPath path = tenMillimetres();
  hand.lead(&path);
  EXPECT_FALSE(hand.hasArrived());
  const HandleState half = after(hand, 0.5);
  EXPECT_NEAR(half.X_DH.translation_mm.x, 5.0, 0.05);
  EXPECT_TRUE(half.pedal);
  EXPECT_FALSE(hand.hasArrived());
  const HandleState end = after(hand, 0.7);
  EXPECT_NEAR(end.X_DH.translation_mm.x, 10.0, 1e-3);
  EXPECT_FALSE(end.pedal);
  EXPECT_TRUE(hand.hasArrived());
}

TEST(LedHand, GoesOnAtItsPaceWhereItIsMeantToPress) {
  // Along y, a millimetre into a wall.
  const auto pressed = [](double patient_mm) {
    return LedPath{[](double t_s) {
                     return HandTarget{{1.0, 10.0 * std::min(t_s, 1.0), 0.0}, {1.0, 0.0, 0.0, 0.0}, false, 0, true};
                   },
                   1.0, patient_mm};
  };
  for (const double patient_mm : {0.0, 1.6}) {
    LedHand hand({});
    const LedPath path = pressed(patient_mm);
    hand.lead(&path);
    after(hand, 1.3, 0.0);
    EXPECT_EQ(hand.hasArrived(), patient_mm > 0.0);
  }
}

TEST(LedHand, WaitsWhereItIsHeldUpAndGoesOnWhenThatGivesWay) {
  LedHand hand({});
  const LedPath path = tenMillimetres();
  hand.lead(&path);
  const HandleState held = after(hand, 2.0, 5.0);
  EXPECT_FALSE(hand.hasArrived()) << "a second too late, before a wall";
  EXPECT_NEAR(held.X_DH.translation_mm.x, 5.0, 0.5);
  EXPECT_TRUE(held.pedal);
  after(hand, 1.0);
  EXPECT_TRUE(hand.hasArrived());
}

TEST(LedHand, BeginsAnotherPathAtItsBeginning) {
  LedHand hand({});
  const LedPath path = tenMillimetres();
  const LedPath up{[](double t_s) {
                     return HandTarget{{10.0, 5.0 * std::min(t_s, 1.0), 0.0}, {1.0, 0.0, 0.0, 0.0}, false, 0, true};
                   },
                   1.0};
  hand.lead(&path);
  after(hand, 1.5);
  hand.lead(&up);
  EXPECT_FALSE(hand.hasArrived());
  EXPECT_NEAR(after(hand, 0.4).X_DH.translation_mm.y, 2.0, 0.05);
}

TEST(LedHand, DoesTheSameEveryTime) {
  const LedPath path = tenMillimetres();
  LedHand one({}), other({});
  one.lead(&path);
  other.lead(&path);
  EXPECT_EQ(after(one, 1.3, 4.0).X_DH.translation_mm, after(other, 1.3, 4.0).X_DH.translation_mm);
}

}  // namespace
}  // namespace haptics
