#include "haptics/tool/bur_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calibration/geometry/units.h"
#include "haptics/tool/tool.h"
#include "tests/haptics/head_distance.h"

namespace haptics {
namespace {

using assets::BurProfile;
using calibration::kPi;

const std::vector<BurShape> kShapes = {{ShapeKind::sphere, 1.3, 0.0},
                                       {ShapeKind::capsule, 0.8, 3.0},
                                       {ShapeKind::capsule, 0.8, 0.0},
                                       {ShapeKind::cylinder, 0.6, 4.0},
                                       {ShapeKind::cylinder, 2.0, 0.5},
                                       {ShapeKind::cone, 1.0, 3.0},
                                       {ShapeKind::cone, 2.0, 0.7},
                                       {ShapeKind::revolved, 0.8, 6.0, BurProfile::flame},
                                       {ShapeKind::revolved, 0.8, 4.0, BurProfile::torpedo},
                                       {ShapeKind::revolved, 1.2, 3.0, BurProfile::pear},
                                       {ShapeKind::revolved, 1.0, 1.5, BurProfile::inverted_cone}};

TEST(BurShape, HasTheVolumeThatItsDistanceEncloses) {
  for (const BurShape& shape : kShapes) {
    // Rings of the half-plane, midpoints.
    constexpr int kCells = 700;
    const double half = halfHeight_mm(shape), drho = shape.radius_mm / kCells, dz = 2.0 * half / kCells;
    double sum = 0.0;
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j) {
        const double rho = (i + 0.5) * drho;
        if (headDistance_mm(shape, {{rho, 0.0, -half + (j + 0.5) * dz}}) < 0.0) sum += 2.0 * kPi * rho * drho * dz;
      }
    EXPECT_NEAR(volume_mm3(shape), sum, 2e-3 * sum);
  }
}

TEST(BurShape, ReachesAsFarAsItsFarthestPoint) {
  for (const BurShape& shape : kShapes) {
    const double R = shape.radius_mm, half = halfHeight_mm(shape);
    EXPECT_NEAR(reach_mm(shape, 1.0), half, 1e-12);
    EXPECT_NEAR(reach_mm(shape, -1.0), half, 1e-12);
    for (const double cos : {-0.9, -0.3, 0.0, 0.4, 0.95}) {
      const glm::dvec3 direction{std::sqrt(1.0 - cos * cos), 0.0, cos};
      double farthest = -1e300;
      // Corners and edges of its box included.
      constexpr int kSteps = 500;
      for (int i = 0; i <= kSteps; ++i)
        for (int j = -kSteps; j <= kSteps; ++j) {
          const glm::dvec3 p{R * i / kSteps, 0.0, half * j / kSteps};
          if (headDistance_mm(shape, {p}) <= 1e-12) farthest = std::max(farthest, glm::dot(p, direction));
        }
      EXPECT_NEAR(reach_mm(shape, cos), farthest, 3e-3 * (1.0 + shape.length_mm)) << cos;
      EXPECT_GE(reach_mm(shape, cos), farthest - 1e-11);
    }
  }
}

TEST(BurShape, IsDrawnBackIntoItsRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const BurShape& shape : kShapes) EXPECT_EQ(sanitised(shape), shape);
  EXPECT_EQ(sanitised(BurShape{ShapeKind::sphere, 0.01, 3.0}), (BurShape{ShapeKind::sphere, 0.1, 0.0}));
  EXPECT_EQ(sanitised(BurShape{ShapeKind::cone, 99.0, 99.0}), (BurShape{ShapeKind::cone, 6.0, 20.0}));
  EXPECT_EQ(sanitised(BurShape{ShapeKind::cylinder, nan, nan}), (BurShape{ShapeKind::cylinder, 2.0, 0.1}));
  EXPECT_EQ(sanitised(BurShape{static_cast<ShapeKind>(9), 1.0, 1.0}), (BurShape{ShapeKind::sphere, 1.0, 0.0}));
  // Never shorter than its outline, never an outline that there is not.
  EXPECT_EQ(sanitised(BurShape{ShapeKind::revolved, 1.0, 0.5, BurProfile::flame}).length_mm, 2.0);
  EXPECT_EQ(sanitised(BurShape{ShapeKind::revolved, 1.0, 5.0, static_cast<BurProfile>(200)}).profile,
            BurProfile::wheel);
  EXPECT_EQ(sanitised(BurShape{ShapeKind::cone, 1.0, 5.0, BurProfile::pear}).profile, BurProfile::wheel);
}

TEST(Tool, HasAShaftThatIsNoThickerThanItsShankAndHead) {
  EXPECT_NEAR(standardShaft({ShapeKind::sphere, 3.0, 0.0}).radius_mm, 1.175, 1e-12);
  EXPECT_LT(standardShaft({ShapeKind::cylinder, 0.6, 4.0}).radius_mm, 0.6);
}

TEST(Tool, IsDrawnBackIntoItsRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sanitised(haptics::Tool{{}, {1.0, nan}}).shaft.length_mm, 0.0);
  EXPECT_EQ(sanitised(haptics::Tool{{}, {-1.0, 10.0}}).shaft.length_mm, 0.0);
  EXPECT_EQ(sanitised(haptics::Tool{{}, {99.0, 999.0}}).shaft.radius_mm, 5.0);
  EXPECT_EQ(sanitised(haptics::Tool{{}, {99.0, 999.0}}).shaft.length_mm, 100.0);
  EXPECT_EQ(sanitised(haptics::Tool{{ShapeKind::cone, 1.0, 99.0}, {1.0, 20.0}}).head.length_mm, 20.0);
}

TEST(Tool, IsOneKindOfInstrumentAtMost) {
  haptics::Tool both = haptics::elevatorTool(ElevatorKind::straight_301);
  both.hand_instrument = HandInstrument::curette;
  EXPECT_FALSE(sanitised(both).isHandInstrument());
  haptics::Tool unknown;
  unknown.hand_instrument = static_cast<HandInstrument>(99);
  EXPECT_TRUE(sanitised(unknown).turns());
  const haptics::Tool scalpel = haptics::handInstrumentTool(HandInstrument::scalpel_15);
  EXPECT_EQ(sanitised(scalpel), scalpel);
  EXPECT_FALSE(scalpel.turns());
  EXPECT_FALSE(scalpel.luxates());
}

}  // namespace
}  // namespace haptics
