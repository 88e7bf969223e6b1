#include "calibration/arm/phantom_kinematics.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/arm/phantom_models.h"

namespace calibration {
namespace {

constexpr std::array kGeometries = {kOmniGeometry, kDesktopGeometry, kPremium15Geometry};

/// Angles that the model can take, its elbow included.
struct AnyJoints {
  std::mt19937 generator{11};
  double within(AngleRange range) {
    return std::uniform_real_distribution<double>(std::max(range.min_rad, -kPi),
                                                  std::min(range.max_rad, kPi))(generator);
  }
  PhantomJoints operator()(const PhantomGeometry& g) {
    PhantomJoints joints;
    do {
      for (int i = 0; i < 3; ++i) joints.arm_rad[i] = within(g.arm[static_cast<std::size_t>(i)]);
    } while (!withinLimits(g, joints.arm_rad));
    for (int i = 0; i < 3; ++i) joints.wrist_rad[i] = within(g.wrist[static_cast<std::size_t>(i)]);
    return joints;
  }
};

TEST(PhantomKinematics, HasTheOmnisPublishedZeroPosition) {
  EXPECT_LT(glm::distance(wristPosition(kOmniGeometry, glm::dvec3(0.0)).mm, glm::dvec3(0.0, -110.0, -35.0)), 1e-12);
  EXPECT_LT(glm::length(wristPosition(kPremium15Geometry, glm::dvec3(0.0)).mm), 1e-12);
}

TEST(PhantomKinematics, ReachesTheInkwellWithTheArmUpright) {
  const auto arm_rad = armAnglesFor(kOmniGeometry, kOmniInkwell_D);
  ASSERT_TRUE(arm_rad);
  EXPECT_NEAR(arm_rad->x, 0.0, 1e-12);
  EXPECT_NEAR(degreesFromRad(arm_rad->y), 15.4, 0.05);
  EXPECT_NEAR(degreesFromRad(arm_rad->z), -21.2, 0.05);
  EXPECT_LT(glm::distance(wristPosition(kOmniGeometry, *arm_rad).mm, kOmniInkwell_D.mm), 1e-9);
}

TEST(PhantomKinematics, HasTheKnownTorqueAtTheInkwell) {
  const glm::dvec3 torque_Nmm =
      armTorque_Nmm(kOmniGeometry, armAnglesFor(kOmniGeometry, kOmniInkwell_D).value(), {{0.0, 3.3, 0.0}});
  EXPECT_NEAR(torque_Nmm.x, 0.0, 1e-9);
  EXPECT_NEAR(torque_Nmm.y, 424.0, 0.5);
  EXPECT_NEAR(torque_Nmm.z, -160.0, 1.0);
}

TEST(PhantomKinematics, MovesInTheDocumentedDirections) {
  // Right, up and towards the user, turret to the left, thigh up, shin out.
  const glm::dmat3 J = armJacobian_mm(kOmniGeometry, glm::dvec3(0.0));
  EXPECT_LT(glm::distance(J[0], glm::dvec3(-133.35, 0.0, 0.0)), 1e-12);
  EXPECT_LT(glm::distance(J[1], glm::dvec3(0.0, 133.35, 0.0)), 1e-12);
  EXPECT_LT(glm::distance(J[2], glm::dvec3(0.0, 0.0, 133.35)), 1e-12);
}

TEST(PhantomKinematics, HasTheJacobianOfDifferences) {
  AnyJoints any;
  for (const PhantomGeometry& g : kGeometries)
    for (int n = 0; n < 500; ++n) {
      const glm::dvec3 q = any(g).arm_rad;
      const glm::dmat3 J = armJacobian_mm(g, q);
      for (int joint = 0; joint < 3; ++joint) {
        constexpr double kStep_rad = 1e-5;
        glm::dvec3 ahead = q, behind = q;
        ahead[joint] += kStep_rad;
        behind[joint] -= kStep_rad;
        const glm::dvec3 slope = (wristPosition(g, ahead).mm - wristPosition(g, behind).mm) / (2.0 * kStep_rad);
        ASSERT_LT(glm::distance(slope, J[joint]), 1e-6 * g.thigh_mm) << "joint " << joint;
      }
      const double out_mm = g.thigh_mm * std::cos(q.y) + g.shin_mm * std::sin(q.z);
      ASSERT_NEAR(glm::determinant(J), -out_mm * g.thigh_mm * g.shin_mm * std::cos(q.y - q.z), 1e-5);
    }
}

TEST(PhantomKinematics, InvertsItsForwardKinematics) {
  AnyJoints any;
  for (const PhantomGeometry& g : kGeometries)
    for (int n = 0; n < 2000; ++n) {
      const PhantomJoints joints = any(g);
      const auto X_DH = handlePose(g, joints);
      const auto found = jointsReaching(g, X_DH);
      ASSERT_TRUE(found) << n;
      const auto again = handlePose(g, *found);
      ASSERT_LT(glm::distance(again.translation_mm, X_DH.translation_mm), 1e-9);
      ASSERT_GT(std::abs(glm::dot(again.rotation, X_DH.rotation)), 1.0 - 1e-12);
      // The same angles, but where the arm is stretched or over its own axis.
      const glm::dvec3 q = joints.arm_rad;
      if (std::abs(glm::determinant(armJacobian_mm(g, q))) < 1e5) continue;
      ASSERT_LT(glm::distance(found->arm_rad, q), 1e-8);
      ASSERT_LT(glm::distance(found->wrist_rad, joints.wrist_rad), 1e-7);
    }
}

TEST(PhantomKinematics, SelectsTheElbowWithinTheLimits) {
  PhantomGeometry down = kOmniGeometry;
  down.arm = {};
  down.elbow = {radFromDegrees(91.0), radFromDegrees(269.0)};
  for (const glm::dvec3& position : {glm::dvec3(0.0), glm::dvec3(40.0, 20.0, -20.0)}) {
    const auto upwards = armAnglesFor(kOmniGeometry, {position}), downwards = armAnglesFor(down, {position});
    ASSERT_TRUE(upwards && downwards);
    EXPECT_LT(glm::distance(wristPosition(down, *downwards).mm, position), 1e-9);
    EXPECT_GT(upwards->y, downwards->y + 0.5);
  }
}

TEST(PhantomKinematics, HasOrthonormalRotations) {
  AnyJoints any;
  for (const PhantomGeometry& g : kGeometries)
    for (int n = 0; n < 500; ++n) {
      const PhantomJoints joints = any(g);
      const glm::dmat3 R = glm::mat3_cast(handlePose(g, joints).rotation);
      const glm::dmat3 off = glm::transpose(R) * R - glm::dmat3(1.0);
      for (int column = 0; column < 3; ++column) ASSERT_LT(glm::length(off[column]), 1e-12);
      // The published matrix, multiplied out from right-handed turns.
      const auto rotation = [](double angle, glm::dvec3 axis) { return glm::mat3_cast(glm::angleAxis(angle, axis)); };
      const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
      const glm::dmat3 published = rotation(-joints.arm_rad.x, y) * rotation(-joints.arm_rad.z, x) *
                                   rotation(joints.wrist_rad.x, y) * rotation(-joints.wrist_rad.y, x) *
                                   rotation(-joints.wrist_rad.z, z);
      for (int column = 0; column < 3; ++column) ASSERT_LT(glm::distance(R[column], published[column]), 1e-12);
    }
}

TEST(PhantomKinematics, ConservesVirtualWork) {
  AnyJoints any;
  for (const PhantomGeometry& g : kGeometries)
    for (int n = 0; n < 200; ++n) {
      const glm::dvec3 q = any(g).arm_rad, dq(any.within({}), any.within({}), any.within({}));
      const Vector<Device> force{{any.within({}), any.within({}), any.within({})}};
      ASSERT_NEAR(glm::dot(armTorque_Nmm(g, q, force), dq), glm::dot(force.xyz, armJacobian_mm(g, q) * dq), 1e-8);
    }
}

TEST(PhantomKinematics, ReachesNothingBeyondItsLinks) {
  for (const PhantomGeometry& g : kGeometries) {
    EXPECT_FALSE(armAnglesFor(g, {g.shoulder_D.mm + glm::dvec3(0.0, 0.0, 1.001 * (g.thigh_mm + g.shin_mm))}));
    EXPECT_FALSE(armAnglesFor(g, {{std::nan(""), 0.0, 0.0}}));
    EXPECT_FALSE(armAnglesFor(g, {g.shoulder_D.mm + glm::dvec3(0.0, -g.shin_mm, -g.thigh_mm)})) << "behind its back";
  }
  // Beyond its upper stop.
  EXPECT_FALSE(jointsReaching(kOmniGeometry, {glm::angleAxis(3.0, glm::dvec3(1, 0, 0)), {0.0, 0.0, 0.0}}));
}

}  // namespace
}  // namespace calibration
