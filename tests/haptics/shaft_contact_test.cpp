#include "haptics/contact/shaft_contact.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using PoseOfTool = calibration::Pose<Patient, calibration::Tool>;

constexpr double kStiffness_N_per_mm = 0.8;
const haptics::Tool kTool{{ShapeKind::sphere, 1.5, 0.0}, {0.8, 25.0}};
/// Turns +z of T into +x of P.
const glm::dquat kLying(glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 0.0));

Contact shaftAt(const SolidField& field, const PoseOfTool& X_PT, const haptics::Tool& tool = kTool) {
  return shaftContact(field, tool, X_PT, TissueStiffness{}, kStiffness_N_per_mm);
}

/// A ledge: bone below z = 0 for x in from..to.
Phantom ledge(double from, double to, double spacing = 0.1) {
  return filled(4.0, spacing, [=](const glm::dvec3& p) { return std::max({p.z, from - p.x, p.x - to}); });
}

TEST(ShaftContact, IsAsDeepAsTheRodLiesHoweverMuchOfItDoes) {
  for (const double length : {1.0, 3.0})
    for (const double h : {0.05, 0.1, 0.2, 0.4}) {
      const Phantom phantom = ledge(0.0, length);
      // The head stays left of the ledge, in air.
      const Contact contact = shaftAt(phantom.field(), {kLying, {-3.5, 0.0, 0.8 - h}});
      EXPECT_NEAR(contact.depth_mm, h, 0.03 + 0.05 * h) << length << ' ' << h;
      EXPECT_NEAR(contact.force_P_N.xyz.z, kStiffness_N_per_mm * contact.depth_mm, 0.02);
      EXPECT_GT(contact.normal_P.xyz.z, 0.99);
    }
}

TEST(ShaftContact, BeginsWithoutAStepAndRises) {
  const Phantom phantom = ledge(0.0, 2.0);
  double last = 0.0;
  for (double h = -0.3; h < 0.4; h += 0.005) {
    const double depth = shaftAt(phantom.field(), {kLying, {-3.5, 0.0, 0.8 - h}}).depth_mm;
    EXPECT_GE(depth, last - 1e-3);
    EXPECT_LT(depth - last, 0.02) << h;
    if (h < -0.06) {
      EXPECT_EQ(depth, 0.0);
    }
    last = depth;
  }
}

TEST(ShaftContact, TurnsTheHandleAboutTheHead) {
  const Phantom phantom = ledge(0.0, 1.0);
  const Contact contact = shaftAt(phantom.field(), {kLying, {-3.5, 0.0, 0.6}});
  // Up at 4 mm from T's origin along x.
  const glm::dvec3 expected = glm::cross(glm::dvec3(4.0, 0.0, -0.7), contact.force_P_N.xyz);
  EXPECT_NEAR(contact.torque_P_Nmm.xyz.y, expected.y, 0.05 * std::abs(expected.y));
  EXPECT_NEAR(contact.torque_P_Nmm.xyz.z, 0.0, 0.01);
}

TEST(ShaftContact, LeavesTheHeadToTheHead) {
  // Bone at the head alone.
  const Phantom phantom = ledge(-4.0, -2.2);
  EXPECT_EQ(shaftAt(phantom.field(), {kLying, {-3.5, 0.0, 0.3}}).depth_mm, 0.0);
}

TEST(ShaftContact, FadesBetweenFacingWalls) {
  const Phantom slot = filled(4.0, 0.1, [](const glm::dvec3& p) { return 0.7 - std::abs(p.z); });
  const Contact middle = shaftAt(slot.field(), {kLying, {-3.5, 0.0, 0.0}});
  EXPECT_LT(glm::length(middle.force_P_N.xyz), 0.02);
  double last = glm::length(middle.force_P_N.xyz);
  for (double z = 0.0; z < 0.3; z += 0.01) {
    const Contact contact = shaftAt(slot.field(), {kLying, {-3.5, 0.0, z}});
    EXPECT_LE(contact.force_P_N.xyz.z, 0.02);
    EXPECT_LT(std::abs(glm::length(contact.force_P_N.xyz) - last), 0.1);
    last = glm::length(contact.force_P_N.xyz);
  }
}

TEST(ShaftContact, IsNothingWithoutAShaft) {
  const Phantom phantom = block(3.0, 0.2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Shaft& none : {Shaft{}, Shaft{0.8, 1.0}, Shaft{nan, 10.0}, Shaft{0.8, nan}, Shaft{-1.0, 10.0}})
    EXPECT_EQ(shaftAt(phantom.field(), {}, {{}, none}).volume_mm3, 0.0);
  EXPECT_EQ(shaftAt(phantom.field(), {{nan, 0.0, 0.0, 0.0}, {}}).volume_mm3, 0.0);
}

}  // namespace
}  // namespace haptics
