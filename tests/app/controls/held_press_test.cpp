#include "app/controls/held_press.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(HeldPress, AShortPressIsATapWhenItEnds) {
  HeldPress press;
  EXPECT_EQ(press.look(0, false, 0.0).taps, 0u);
  EXPECT_EQ(press.look(1, true, 0.1).taps, 0u) << "it may become a hold";
  const HeldPress::Seen seen = press.look(1, false, 0.2);
  EXPECT_EQ(seen.taps, 1u);
  EXPECT_FALSE(seen.began || seen.ended);
}

TEST(HeldPress, ALongOneBeginsOnceAndEndsWithoutATap) {
  HeldPress press;
  press.look(0, false, 0.0);
  press.look(1, true, 1.0);
  EXPECT_FALSE(press.look(1, true, 1.2).began);
  EXPECT_TRUE(press.look(1, true, 1.3).began);
  EXPECT_FALSE(press.look(1, true, 2.0).began);
  const HeldPress::Seen seen = press.look(1, false, 2.5);
  EXPECT_TRUE(seen.ended);
  EXPECT_EQ(seen.taps, 0u);
  EXPECT_FALSE(press.look(1, false, 2.6).ended);
}

TEST(HeldPress, PressesBetweenTwoLooksAreTaps) {
  HeldPress press;
  press.look(4, false, 0.0);
  EXPECT_EQ(press.look(6, false, 0.1).taps, 2u);
  EXPECT_EQ(press.look(8, true, 0.2).taps, 1u) << "the second is still down";
  EXPECT_TRUE(press.look(8, true, 0.6).began);
}

TEST(HeldPress, APressDuringAHoldEndsItAndMayBecomeTheNext) {
  HeldPress press;
  press.look(0, false, 0.0);
  press.look(1, true, 0.0);
  EXPECT_TRUE(press.look(1, true, 0.4).began);
  const HeldPress::Seen seen = press.look(2, true, 0.5);
  EXPECT_TRUE(seen.ended);
  EXPECT_EQ(seen.taps, 0u);
  EXPECT_TRUE(press.look(2, true, 0.9).began);
}

}  // namespace
}  // namespace app
