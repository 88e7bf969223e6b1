#include "assets/synthetic/mouth_rim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace assets {
namespace {

/// A rim on a face like a barrel.
const MouthRim& rim() {
  static const MouthRim made([](double x_mm, double z_mm) { return -20.0 + 0.01 * x_mm * x_mm + 0.002 * z_mm * z_mm; },
                             0.0);
  return made;
}

glm::dvec3 someDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

TEST(MouthRim, DistancesChangeNoFasterThanThePlace) {
  // A part of the rim that is passed over by mistake would show as a jump. The lip's radius changes along it.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-60.0, 80.0), y(-40.0, 40.0), z(-40.0, 70.0);
  constexpr double kStep_mm = 0.02;
  for (int n = 0; n < 200'000; ++n) {
    const glm::dvec3 p(x(random), y(random), z(random)), q = p + kStep_mm * someDirection(random);
    ASSERT_NEAR(rim().lip(p).distance_mm, rim().lip(q).distance_mm, 1.2 * kStep_mm) << p.x << ' ' << p.y << ' ' << p.z;
    ASSERT_NEAR(rim().opening_mm(p.x, p.z), rim().opening_mm(q.x, q.z), 1.001 * kStep_mm) << p.x << ' ' << p.z;
  }
}

TEST(MouthRim, IsOpenInItsMiddleAndClosedAround) {
  EXPECT_LT(rim().opening_mm(8.0, 15.0), -15.0);
  EXPECT_GT(rim().opening_mm(8.0, 60.0), 10.0);
  EXPECT_GT(rim().opening_mm(80.0, 15.0), 25.0);
  // The lip lies just outside the edge: what is well inside the opening is off the lip.
  EXPECT_GT(rim().lip({8.0, -20.0, 15.0}).distance_mm, 15.0);
}

TEST(MouthRim, KnowsHowFarAlongTheLipAPlaceIs) {
  const glm::dvec3 corner = rim().retractedCorner_mm();
  EXPECT_LT(rim().lip(corner).distance_mm, -2.0);
  EXPECT_NEAR(rim().lip(corner).fraction, 13.0 / 40.0, 0.01);
}

}  // namespace
}  // namespace assets
