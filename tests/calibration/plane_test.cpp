#include "calibration/geometry/plane.h"

#include <gtest/gtest.h>

#include "calibration/geometry/frames.h"

namespace calibration {
namespace {

TEST(Plane, ReflectsAcrossItself) {
  const Plane<World> mirror{glm::normalize(glm::dvec3(0, 1, 1)), 10.0};
  const Point<World> p{{3, 4, 5}};
  EXPECT_NEAR(mirror.distance_mm(mirror.reflect(p)), -mirror.distance_mm(p), 1e-12);
  EXPECT_LT(glm::distance(mirror.reflect(mirror.reflect(p)).mm, p.mm), 1e-12);
}

TEST(Plane, LeavesItsOwnPointsAlone) {
  const Plane<World> mirror{{0, 0, 1}, 2.0};
  EXPECT_EQ(mirror.reflect({{7, 8, 2}}).mm, glm::dvec3(7, 8, 2));
}

}  // namespace
}  // namespace calibration
