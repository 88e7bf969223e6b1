#include "haptics/contact/immersion.h"

#include <gtest/gtest.h>

#include "haptics/tool/flat_overlap.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Pose;
using calibration::Tool;

const std::vector<BurShape> kShapes = {{ShapeKind::sphere, 1.5, 0.0},
                                       {ShapeKind::capsule, 1.0, 2.5},
                                       {ShapeKind::cylinder, 1.0, 3.0},
                                       {ShapeKind::cone, 1.2, 3.0},
                                       {ShapeKind::revolved, 1.0, 3.2, assets::BurProfile::torpedo}};

Immersion contactAt(const SolidField& field, const BurShape& head, const Pose<Patient, Tool>& X_PT) {
  const TissueStiffness tissue;
  return shapeImmersion({field, head, X_PT, tissue, {}});
}

/// Turned so that the axis stands at an angle to `normal`, and so deep in the bone below it.
Pose<Patient, Tool> posed(const BurShape& head, double angle_deg, double depth, const glm::dvec3& normal) {
  const glm::dvec3 side = glm::normalize(glm::cross(normal, glm::dvec3(0.31, 0.52, -0.2)));
  const double angle = glm::radians(angle_deg);
  const glm::dvec3 axis = std::cos(angle) * normal + std::sin(angle) * side;
  return {glm::dquat(glm::dvec3(0.0, 0.0, 1.0), axis), normal * (reach_mm(head, -std::cos(angle)) - depth)};
}

TEST(Immersion, FindsDepthAndNormalOfAFlatFaceAtAnyAngle) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.4, -0.3, 0.85));
  const Phantom phantom = halfSpace(3.0, 0.1, normal, {0.013, 0.027, 0.041});
  for (const BurShape& head : kShapes)
    for (const double angle : {0.0, 20.0, 45.0, 70.0, 90.0, 110.0})
      for (const double h : {0.1, 0.25, 0.6, 0.9}) {
        const Immersion contact = contactAt(phantom.field(), head, posed(head, angle, h, normal));
        const double off = std::abs(contact.depth_mm - h);
        // Flush against an end the first touch is the rim: a turn of 1° of the normal counts R sin 1°.
        EXPECT_LT(off, h < 0.25 ? 0.03 : 0.015) << static_cast<int>(head.kind) << ' ' << angle << "° " << h;
        if (h < 0.25) continue;
        const double turned = glm::degrees(std::acos(std::min(1.0, glm::dot(contact.normal_P.xyz, normal))));
        EXPECT_LT(turned, 1.2) << static_cast<int>(head.kind) << ' ' << angle << "° " << h;
        EXPECT_NEAR(glm::length(contact.normal_P.xyz), 1.0, 1e-6);
        EXPECT_GT(contact.one_sided, 0.93) << static_cast<int>(head.kind) << ' ' << angle << "° " << h;
      }
}

TEST(Immersion, IsAgussContactForASphere) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1, 0.2, 0.9));
  const Phantom phantom = halfSpace(3.0, 0.1, normal);
  for (const double h : {0.02, 0.1, 0.5, 1.4, 2.4}) {
    const Pose<Patient, Tool> X_PT = posed(kShapes[0], 30.0, h, normal);
    const Immersion any = contactAt(phantom.field(), kShapes[0], X_PT);
    const Immersion agus = sphereImmersion(phantom.field(), {X_PT.translation_mm}, kShapes[0].radius_mm);
    EXPECT_NEAR(any.depth_mm, agus.depth_mm, 2e-3) << h;
    EXPECT_LT(glm::distance(any.normal_P.xyz, agus.normal_P.xyz), 1e-5) << h;
  }
}

TEST(Immersion, ActsWhereTheBoneIs) {
  // A capsule on its side, with bone under its tip's half alone: the force turns it tip up.
  const Phantom phantom = filled(3.0, 0.1, [](const glm::dvec3& p) { return std::max(p.z, p.x + 0.5); });
  const BurShape head = kShapes[1];
  const Pose<Patient, Tool> X_PT{glm::dquat(glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 0.0)), {0.0, 0.0, 0.8}};
  const Immersion contact = contactAt(phantom.field(), head, X_PT);
  EXPECT_GT(contact.normal_P.xyz.z, 0.9);
  EXPECT_LT(contact.arm_P_mm.xyz.x, -0.7);
  EXPECT_NEAR(contact.arm_P_mm.xyz.y, 0.0, 0.01);
}

TEST(Immersion, LosesItsDirectionWhereBoneIsAllAround) {
  const Phantom phantom = block(4.0, 0.1);
  for (const BurShape& head : kShapes) {
    const Immersion contact = contactAt(phantom.field(), head, {glm::normalize(glm::dquat(1.0, 0.2, 0.4, 0.1)), {}});
    EXPECT_NEAR(contact.depth_mm, contact.depth_mm, 0.0);
    EXPECT_LT(glm::length(contact.normal_P.xyz), 0.2) << static_cast<int>(head.kind);
    EXPECT_LT(contact.one_sided, 0.1);
  }
}

TEST(Immersion, IsHardlyOneSidedInASlot) {
  // Walls 1.8 mm apart hold a capsule of 2 mm.
  const Phantom phantom = filled(3.0, 0.1, [](const glm::dvec3& p) { return 0.9 - std::abs(p.x); });
  const Immersion contact = contactAt(phantom.field(), kShapes[1], {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}});
  EXPECT_GT(contact.depth_mm, 0.0);
  EXPECT_LT(contact.one_sided, 0.05);
}

TEST(Immersion, AnswersNothingInAir) {
  const Phantom phantom = halfSpace(3.0, 0.2);
  for (const BurShape& head : kShapes) {
    const Immersion contact = contactAt(phantom.field(), head, posed(head, 30.0, -0.5, {0.0, 0.0, 1.0}));
    EXPECT_EQ(contact.volume_mm3, 0.0);
    EXPECT_EQ(contact.depth_mm, 0.0);
  }
}

}  // namespace
}  // namespace haptics
