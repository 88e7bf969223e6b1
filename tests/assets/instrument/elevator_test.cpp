#include "assets/instrument/elevator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "tests/assets/instrument/part_named.h"
#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

using glm::dvec3;

constexpr ElevatorForm kForms[] = {ElevatorForm::straight_301, ElevatorForm::straight_34s, ElevatorForm::cryer_left,
                                   ElevatorForm::cryer_right};

TEST(Elevator, IsMadeOfClosedSurfacesWithoutHandles) {
  for (const ElevatorForm form : kForms)
    for (const MeshPart& part : elevator(form).parts) {
      EXPECT_EQ(test::opennessOf(part.triangles), "") << part.name;
      EXPECT_EQ(test::eulerCharacteristic(part.triangles), 2) << part.name;
      EXPECT_GT(test::volume(part), 0.0) << part.name << " " << static_cast<int>(form);
    }
}

TEST(Elevator, HasFiniteUnitNormals) {
  for (const ElevatorForm form : kForms)
    for (const MeshPart& part : elevator(form).parts) {
      ASSERT_EQ(part.normal.size(), part.position_mm.size());
      for (const glm::vec3& p : part.position_mm) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << part.name;
      for (const glm::vec3& n : part.normal) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << part.name;
    }
}

TEST(Elevator, StraightBladesAreAsWideAndThickAsTheirPatterns) {
  for (const auto& [form, width_mm, thickness_mm, length_mm] :
       {std::tuple{ElevatorForm::straight_301, 3.0f, 1.0f, 8.0f}, {ElevatorForm::straight_34s, 4.0f, 1.3f, 9.0f}}) {
    glm::vec3 low(1e9f), high(-1e9f);
    const MeshModel model = elevator(form);
    for (const glm::vec3& p : tests::partNamed(model, "Blade").position_mm) {
      if (p.z > length_mm + 1e-3f) continue;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    EXPECT_NEAR(high.x - low.x, width_mm, 0.03f);
    EXPECT_NEAR(high.y - low.y, thickness_mm, 0.03f);
    EXPECT_NEAR(low.z, 0.0f, 0.01f);
  }
}

TEST(Elevator, CryersTipsLieLevelWithTheOriginLeftAndRight) {
  for (const auto& [form, side] : {std::pair{ElevatorForm::cryer_left, -1.0f}, {ElevatorForm::cryer_right, 1.0f}}) {
    float reach_mm = 0.0f, level_mm = 1e9f;
    const MeshModel model = elevator(form);
    for (const glm::vec3& p : tests::partNamed(model, "Blade").position_mm)
      if (side * p.x > reach_mm) reach_mm = side * p.x, level_mm = p.z;
    EXPECT_NEAR(reach_mm, 9.0f * std::sin(1.74533f), 0.05f);
    EXPECT_NEAR(level_mm, 0.0f, 0.3f);
  }
}

TEST(Elevator, HandleAndShankAreRoundAndJoinTheBlade) {
  for (const ElevatorForm form : kForms) {
    const MeshModel model = elevator(form);
    float blade_to_mm = -1e9f, shank_from_mm = 1e9f, shank_to_mm = -1e9f, handle_from_mm = 1e9f, handle_to_mm = -1e9f;
    for (const glm::vec3& p : tests::partNamed(model, "Blade").position_mm) blade_to_mm = std::max(blade_to_mm, p.z);
    for (const glm::vec3& p : tests::partNamed(model, "Shank").position_mm)
      shank_from_mm = std::min(shank_from_mm, p.z), shank_to_mm = std::max(shank_to_mm, p.z);
    for (const glm::vec3& p : tests::partNamed(model, "Handle").position_mm) {
      handle_from_mm = std::min(handle_from_mm, p.z), handle_to_mm = std::max(handle_to_mm, p.z);
      EXPECT_LT(std::hypot(p.x, p.y), 8.1f);
    }
    EXPECT_LT(shank_from_mm, blade_to_mm);
    EXPECT_LE(handle_from_mm, shank_to_mm);
    EXPECT_NEAR(handle_to_mm - handle_from_mm, 80.0f, 1.0f);
  }
}

}  // namespace
}  // namespace assets
