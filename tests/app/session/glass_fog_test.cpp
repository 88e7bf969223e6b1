#include "app/session/glass_fog.h"

#include <gtest/gtest.h>

#include <cmath>

namespace app {
namespace {

TEST(GlassFog, BreathMistsAGlassInTheMouthSlowlyAndNotOneOutsideIt) {
  GlassFog inside, outside;
  inside.step(15.0, {20.0, false, false});
  outside.step(15.0, {80.0, false, false});
  EXPECT_NEAR(inside.share(), 0.3 * (1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_EQ(outside.share(), 0.0);
  inside.step(30.0, {80.0, false, false});
  EXPECT_LT(inside.share(), 0.01) << "it clears outside";
}

TEST(GlassFog, SprayWetsItMoreTheNearerItIsAndAirDriesIt) {
  GlassFog near, far;
  near.step(3.0, {10.0, true, true});
  far.step(3.0, {45.0, true, true});
  EXPECT_GT(near.share(), 0.35);
  EXPECT_LT(far.share(), 0.1);
  const double wet = near.share();
  near.step(8.0, {10.0, true, false});
  EXPECT_LT(near.share(), 0.5 * wet) << "dry drilling sprays nothing";
}

TEST(GlassFog, WaterRinsesOffBreath) {
  GlassFog fog;
  fog.step(60.0, {40.0, false, true});
  EXPECT_GT(fog.share(), 0.29) << "no motor, no water";
  fog.step(64.0, {40.0, true, true});
  EXPECT_LT(fog.share(), 0.06) << "drops at the rim of the spray are left";
  fog.step(70.0, {40.0, false, true});
  EXPECT_GT(fog.share(), 0.05) << "and breath comes again";
}

TEST(GlassFog, ManySmallStepsAreOneLargeOneAndItStaysAShare) {
  GlassFog one, many;
  one.step(4.0, {12.0, true, true});
  for (int n = 1; n <= 400; ++n) {
    many.step(0.01 * n, {12.0, true, true});
    ASSERT_GE(many.share(), 0.0);
    ASSERT_LE(many.share(), 1.0);
  }
  EXPECT_NEAR(one.share(), many.share(), 1e-9);
  many.step(3.0, {12.0, true, true});
  EXPECT_NEAR(one.share(), many.share(), 1e-9) << "time does not go back";
}

}  // namespace
}  // namespace app
