#include "haptics/device/usb/falcon_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/geometry/units.h"

#include "tests/haptics/usb/falcon_inverse.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::Point;

/// Places in the cylinder that the published workspace is, 10 cm across.
class Places {
 public:
  Point<Device> next() {
    const double angle = 2.0 * calibration::kPi * unit_(random_), radius = 50.0 * std::sqrt(unit_(random_));
    return {{radius * std::cos(angle), radius * std::sin(angle), 75.0 + 85.0 * unit_(random_)}};
  }
  glm::dvec3 step() { return glm::dvec3(unit_(random_), unit_(random_), unit_(random_)) * 2.0 - 1.0; }

 private:
  std::mt19937 random_{3};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

TEST(FalconKinematics, EncodersFollowWheelAndDrum) {
  // 1280 counts are a turn of the 14.25 mm shaft, which is 14.25/110 of a turn of the arm: 46.636 degrees.
  const FalconLegs legs = falconLegs_rad({0, 1280, -1280});
  EXPECT_NEAR(calibration::degreesFromRad(legs.x), 35.0, 1e-12);
  EXPECT_NEAR(calibration::degreesFromRad(legs.y), 35.0 + 46.636363636, 1e-8);
  EXPECT_NEAR(calibration::degreesFromRad(legs.z), 35.0 - 46.636363636, 1e-8);
}

TEST(FalconKinematics, ALegIsAThighTwoLinksAndAShinOfTheirLengths) {
  // By hand for leg 1 at 105 degrees: from its own axis to the knee, the rest must be as long as links and shin.
  Places places;
  for (int i = 0; i < 2000; ++i) {
    const Point<Device> grip = places.next();
    const auto legs = falconLegsAt_rad(grip);
    ASSERT_TRUE(legs);
    const double turn = calibration::radFromDegrees(105.0);
    const glm::dvec3 u(std::cos(turn), std::sin(turn), 0.0), v(-std::sin(turn), std::cos(turn), 0.0), w(0, 0, 1);
    const glm::dvec3 hip = 40.0 * u - 23.09 * v;
    const glm::dvec3 knee = hip + 60.0 * (std::cos(legs->x) * u + std::sin(legs->x) * w);
    const glm::dvec3 ankle = grip.mm + 14.43 * u - 25.0 * v;
    const glm::dvec3 rest = ankle - knee;
    const double sideways = glm::dot(rest, v), along = glm::length(rest - sideways * v);
    ASSERT_NEAR(along, 22.5 + std::sqrt(102.5 * 102.5 - sideways * sideways), 1e-9);
  }
}

TEST(FalconKinematics, ForwardUndoesInverse) {
  Places places;
  for (int i = 0; i < 20'000; ++i) {
    const Point<Device> grip = places.next();
    const auto legs = falconLegsAt_rad(grip);
    ASSERT_TRUE(legs);
    const auto back = falconGrip(*legs, {grip.mm + 5.0 * places.step()});
    ASSERT_TRUE(back);
    ASSERT_LT(glm::length(back->mm - grip.mm), 1e-9);
    const auto legs_again = falconLegsAt_rad(*back);
    ASSERT_TRUE(legs_again);
    ASSERT_LT(glm::length(*legs_again - *legs), 1e-11);
  }
}

TEST(FalconKinematics, ForwardFindsTheGripFromTheMiddleToo) {
  Places places;
  for (int i = 0; i < 20'000; ++i) {
    const Point<Device> grip = places.next();
    const auto found = falconGrip(*falconLegsAt_rad(grip), falconMiddle());
    ASSERT_TRUE(found) << grip.mm.x << " " << grip.mm.y << " " << grip.mm.z;
    ASSERT_LT(glm::length(found->mm - grip.mm), 1e-9);
  }
}

TEST(FalconKinematics, TheJacobianIsTheSlopeOfTheForwardKinematics) {
  Places places;
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const Point<Device> grip = places.next();
    const FalconLegs legs = *falconLegsAt_rad(grip);
    const glm::dmat3 J = falconJacobian_mm(legs, grip);
    for (glm::length_t leg = 0; leg < 3; ++leg) {
      const double h = 1e-4;
      const auto at = [&](double d_rad) {
        FalconLegs moved = legs;
        moved[leg] += d_rad;
        return falconGrip(moved, grip)->mm;
      };
      // Fourth order, so that the difference is the Jacobian's error and not the quotient's.
      const glm::dvec3 slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
      worst = std::max(worst, glm::length(slope - J[leg]) / glm::length(J[leg]));
    }
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(FalconKinematics, ForceAndTorqueDoTheSameWork) {
  // F . dp = (J^T F) . dq for any small turn of the legs.
  Places places;
  for (int i = 0; i < 5000; ++i) {
    const Point<Device> grip = places.next();
    const FalconLegs legs = *falconLegsAt_rad(grip);
    const glm::dvec3 torque = glm::transpose(falconJacobian_mm(legs, grip)) * glm::dvec3(0.3, -0.8, 1.1);
    const glm::dvec3 turn = 1e-5 * places.step();
    const glm::dvec3 move = (falconGrip(legs + turn, grip)->mm - falconGrip(legs - turn, grip)->mm) / 2.0;
    ASSERT_NEAR(glm::dot(glm::dvec3(0.3, -0.8, 1.1), move), glm::dot(torque, turn), 1e-8);
  }
}

TEST(FalconKinematics, AForceTowardsTheHandLoadsAllLegsEquallyInTheMiddle) {
  const Point<Device> grip = falconMiddle();
  const glm::dvec3 torque = glm::transpose(falconJacobian_mm(*falconLegsAt_rad(grip), grip)) * glm::dvec3(0, 0, 1);
  EXPECT_GT(torque.x, 10.0);
  EXPECT_NEAR(torque.x, torque.y, 1e-9);
  EXPECT_NEAR(torque.x, torque.z, 1e-9);
}

TEST(FalconKinematics, HasNoSolutionOutOfReachAndTerminatesForAnyEncoders) {
  EXPECT_FALSE(falconLegsAt_rad({{0.0, 0.0, 400.0}}));
  EXPECT_FALSE(falconLegsAt_rad({{200.0, 0.0, 100.0}}));
  EXPECT_FALSE(falconLegsAt_rad({{std::nan(""), 0.0, 100.0}}));
  EXPECT_FALSE(falconGrip({std::nan(""), 0.0, 0.0}, falconMiddle()));
  EXPECT_FALSE(falconGrip({0.5, 0.5, 0.5}, {{INFINITY, 0.0, 0.0}}));
  EXPECT_EQ(falconJacobian_mm({0.5, 0.5, 0.5}, {{300.0, 0.0, 0.0}}), glm::dmat3(0.0));

  std::mt19937 random(5);
  int found = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto any = [&] { return static_cast<std::int16_t>(random()); };
    const FalconLegs legs = falconLegs_rad({any(), any(), any()});
    if (const auto grip = falconGrip(legs, falconMiddle())) {
      ++found;
      ASSERT_TRUE(std::isfinite(glm::length(grip->mm)));
    }
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace haptics
