#include "haptics/tool/bur_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "calibration/geometry/units.h"
#include "haptics/tool/tool.h"

namespace haptics {
namespace {

using calibration::kPi;
using calibration::Point;

const std::vector<BurShape> kShapes = {{ShapeKind::sphere, 1.3, 0.0},   {ShapeKind::capsule, 0.8, 3.0},
                                       {ShapeKind::capsule, 0.8, 0.0},  {ShapeKind::cylinder, 0.6, 4.0},
                                       {ShapeKind::cylinder, 2.0, 0.5}, {ShapeKind::cone, 1.0, 3.0},
                                       {ShapeKind::cone, 2.0, 0.7}};

/// The outline as many points: what the distance is checked against.
double nearestOutlinePoint(const BurShape& shape, double rho, double z) {
  const double R = shape.radius_mm, half = 0.5 * shape.length_mm;
  std::vector<glm::dvec2> outline;
  constexpr int kPoints = 8000;
  for (int i = 0; i <= kPoints; ++i) {
    const double t = static_cast<double>(i) / kPoints, turn = kPi * (t - 0.5);
    if (shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::capsule) {
      outline.emplace_back(R * std::cos(turn), R * std::sin(turn) + (turn < 0.0 ? -half : half));
      outline.emplace_back(R, half * (2.0 * t - 1.0));
    } else {
      outline.emplace_back(R * t, half);
      if (shape.kind == ShapeKind::cylinder) outline.emplace_back(R * t, -half);
      outline.emplace_back(shape.kind == ShapeKind::cylinder ? R : R * t, half * (2.0 * t - 1.0));
    }
  }
  double least = 1e300;
  for (const glm::dvec2& p : outline) least = std::min(least, glm::distance(p, glm::dvec2(rho, z)));
  return least;
}

bool isInside(const BurShape& shape, double rho, double z) {
  const double half = 0.5 * shape.length_mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return rho * rho + z * z < shape.radius_mm * shape.radius_mm;
    case ShapeKind::capsule:
      return std::hypot(rho, std::max(0.0, std::abs(z) - half)) < shape.radius_mm;
    case ShapeKind::cylinder:
      return rho < shape.radius_mm && std::abs(z) < half;
    case ShapeKind::cone:
      return std::abs(z) < half && rho < shape.radius_mm * (z + half) / shape.length_mm;
  }
  return false;
}

TEST(BurShape, MeasuresTheDistanceToItsOutline) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  for (const BurShape& shape : kShapes)
    for (int trial = 0; trial < 40; ++trial) {
      const glm::dvec3 p{place(random), place(random), place(random)};
      const double rho = std::hypot(p.x, p.y), slow = nearestOutlinePoint(shape, rho, p.z);
      const double signed_slow = isInside(shape, rho, p.z) ? -slow : slow;
      EXPECT_NEAR(surfaceDistance(shape, {p}).distance_mm, signed_slow, 5e-4) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

TEST(BurShape, HasAUnitGradientThatIsTheSlopeOfTheDistance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  constexpr double kStep = 1e-6;
  for (const BurShape& shape : kShapes) {
    int smooth = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const glm::dvec3 p{place(random), place(random), place(random)};
      const glm::dvec3 gradient = surfaceDistance(shape, {p}).gradient_T.xyz;
      EXPECT_NEAR(glm::length(gradient), 1.0, 1e-12);
      glm::dvec3 slope;
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step{0.0};
        step[axis] = kStep;
        slope[axis] =
            (surfaceDistance(shape, {p + step}).distance_mm - surfaceDistance(shape, {p - step}).distance_mm) /
            (2.0 * kStep);
      }
      smooth += glm::distance(slope, gradient) < 1e-5;
    }
    EXPECT_GE(smooth, 498) << "all but a step across an inner crease";
  }
}

TEST(BurShape, HasTheVolumeThatItsDistanceEncloses) {
  for (const BurShape& shape : kShapes) {
    // Rings of the half-plane, midpoints.
    constexpr int kCells = 700;
    const double half = halfHeight_mm(shape), drho = shape.radius_mm / kCells, dz = 2.0 * half / kCells;
    double sum = 0.0;
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j) {
        const double rho = (i + 0.5) * drho;
        if (surfaceDistance(shape, {{rho, 0.0, -half + (j + 0.5) * dz}}).distance_mm < 0.0)
          sum += 2.0 * kPi * rho * drho * dz;
      }
    EXPECT_NEAR(volume_mm3(shape), sum, 2e-3 * sum);
  }
}

TEST(BurShape, ReachesAsFarAsItsFarthestPoint) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const BurShape& shape : kShapes) {
    EXPECT_NEAR(reach_mm(shape, 1.0), halfHeight_mm(shape), 1e-12);
    EXPECT_NEAR(reach_mm(shape, -1.0), halfHeight_mm(shape), 1e-12);
    for (const double cos : {-0.9, -0.3, 0.0, 0.4, 0.95}) {
      const glm::dvec3 direction{std::sqrt(1.0 - cos * cos), 0.0, cos};
      double farthest = -1e300;
      for (int trial = 0; trial < 50000; ++trial) {
        // From far out a step of the distance back along the gradient lands on the surface.
        const glm::dvec3 p = 6.0 * (direction + 0.4 * glm::dvec3(unit(random), 0.0, unit(random)));
        const SurfaceDistance at = surfaceDistance(shape, {p});
        farthest = std::max(farthest, glm::dot(p - at.distance_mm * at.gradient_T.xyz, direction));
      }
      EXPECT_NEAR(reach_mm(shape, cos), farthest, 3e-3 * (1.0 + shape.length_mm)) << cos;
      EXPECT_GE(reach_mm(shape, cos), farthest - 1e-12);
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
}

TEST(Tool, HasAShaftThatIsNoThickerThanItsShankAndHead) {
  EXPECT_NEAR(usualShaft({ShapeKind::sphere, 3.0, 0.0}).radius_mm, 1.175, 1e-12);
  EXPECT_LT(usualShaft({ShapeKind::cylinder, 0.6, 4.0}).radius_mm, 0.6);
}

TEST(Tool, IsDrawnBackIntoItsRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sanitised(haptics::Tool{{}, {1.0, nan}}).shaft.length_mm, 0.0);
  EXPECT_EQ(sanitised(haptics::Tool{{}, {-1.0, 10.0}}).shaft.length_mm, 0.0);
  EXPECT_EQ(sanitised(haptics::Tool{{}, {99.0, 999.0}}).shaft.radius_mm, 5.0);
  EXPECT_EQ(sanitised(haptics::Tool{{}, {99.0, 999.0}}).shaft.length_mm, 100.0);
  EXPECT_EQ(sanitised(haptics::Tool{{ShapeKind::cone, 1.0, 99.0}, {1.0, 20.0}}).head.length_mm, 20.0);
}

}  // namespace
}  // namespace haptics
