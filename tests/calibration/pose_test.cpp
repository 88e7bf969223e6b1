#include "calibration/geometry/pose.h"

#include <random>

#include <gtest/gtest.h>

#include "calibration/geometry/frames.h"

namespace calibration {
namespace {

template <class X, class Y>
concept Composes = requires(X x, Y y) {
  x* y;
};

static_assert(Composes<Pose<World, Device>, Pose<Device, Handle>>);
static_assert(!Composes<Pose<World, Device>, Pose<Handle, Device>>, "frames that do not meet must not compile");
static_assert(!Composes<Pose<World, Device>, Point<World>>);
static_assert(std::is_trivially_copyable_v<Pose<World, Tool>>);

struct RandomPoses {
  std::mt19937 generator{7};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  double number() { return uniform(generator); }
  glm::dvec3 vector() { return {number(), number(), number()}; }
  template <class A, class B>
  Pose<A, B> pose() {
    return {glm::normalize(glm::dquat(number(), number(), number(), number())), 100.0 * vector()};
  }
};

TEST(Pose, ComposesLikeItsMatrices) {
  RandomPoses random;
  for (int i = 0; i < 200; ++i) {
    const auto X_WD = random.pose<World, Device>();
    const auto X_DH = random.pose<Device, Handle>();
    const Point<Handle> p_H{50.0 * random.vector()};
    const glm::dvec3 by_pose = (X_WD * X_DH * p_H).mm;
    const glm::dvec3 by_matrix = glm::dvec3(X_WD.matrix() * X_DH.matrix() * glm::dvec4(p_H.mm, 1.0));
    EXPECT_LT(glm::distance(by_pose, by_matrix), 1e-11);
  }
}

TEST(Pose, InverseUndoes) {
  RandomPoses random;
  for (int i = 0; i < 200; ++i) {
    const auto X_WP = random.pose<World, Patient>();
    const Point<Patient> p_P{80.0 * random.vector()};
    EXPECT_LT(glm::distance((X_WP.inverse() * (X_WP * p_P)).mm, p_P.mm), 1e-11);
  }
}

TEST(Pose, VectorsTurnButDoNotMove) {
  const Pose<World, Tool> X_WT{glm::angleAxis(0.5, glm::dvec3(0, 0, 1)), {10, 20, 30}};
  const Vector<World> v_W = X_WT * Vector<Tool>{{1, 0, 0}};
  EXPECT_NEAR(v_W.xyz.x, std::cos(0.5), 1e-15);
  EXPECT_NEAR(v_W.xyz.y, std::sin(0.5), 1e-15);
}

TEST(Pose, DefaultIsIdentity) { EXPECT_EQ((Pose<World, Tool>{} * Point<Tool>{{1, 2, 3}}).mm, glm::dvec3(1, 2, 3)); }

}  // namespace
}  // namespace calibration
