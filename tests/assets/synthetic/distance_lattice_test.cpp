#include "assets/synthetic/distance_lattice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace assets {
namespace {

const BoundingBox kBox{{-6.0, -6.0, -6.0}, {6.0, 6.0, 6.0}};

TEST(DistanceLattice, RedistancesAnyField) {
  // An ellipsoid's equation is not a distance; along its axes the distance is known.
  DistanceLattice lattice(kBox, 0.2,
                          [](const glm::dvec3& p) { return glm::length(p / glm::dvec3(4.0, 3.0, 2.0)) - 1.0; });
  lattice.redistance();
  EXPECT_NEAR(lattice.at({5.0, 0.0, 0.0}), 1.0, 0.08);
  EXPECT_NEAR(lattice.at({0.0, 4.5, 0.0}), 1.5, 0.08);
  EXPECT_NEAR(lattice.at({0.0, 0.0, 1.0}), -1.0, 0.08);
  EXPECT_NEAR(lattice.at({0.0, 0.0, 2.0}), 0.0, 0.02);
}

TEST(DistanceLattice, KeepsASphereRoundInBothInterpolations) {
  const DistanceLattice lattice(kBox, 0.25, [](const glm::dvec3& p) { return glm::length(p) - 3.0; });
  for (int n = 0; n < 200; ++n) {
    const double turn = 0.37 * n, height = std::cos(0.11 * n);
    const double ring = std::sqrt(1.0 - height * height);
    const glm::dvec3 p = 3.0 * glm::dvec3(ring * std::cos(turn), ring * std::sin(turn), height);
    EXPECT_NEAR(lattice.at(p), 0.0, 0.01);
    EXPECT_NEAR(lattice.smoothAt(p), 0.0, 0.02);
  }
}

TEST(DistanceLattice, GrowsOutsideItsBox) {
  const DistanceLattice lattice(kBox, 0.5, [](const glm::dvec3& p) { return glm::length(p) - 3.0; });
  EXPECT_NEAR(lattice.at({10.0, 0.0, 0.0}), 7.0, 0.05);
  EXPECT_GE(lattice.at({10.0, 10.0, 0.0}), 7.0);
}

TEST(DistanceLattice, FindsPointsOnTheSurface) {
  const DistanceLattice lattice(kBox, 0.25, [](const glm::dvec3& p) { return glm::length(p) - 3.0; });
  const auto points = lattice.surfacePoints_mm();
  EXPECT_GT(points.size(), 1000u);
  for (const glm::dvec3& p : points) EXPECT_NEAR(glm::length(p), 3.0, 0.02);
}

}  // namespace
}  // namespace assets
