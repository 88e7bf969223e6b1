#include "assets/instrument/forceps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/assets/instrument/part_named.h"
#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

using glm::dvec3;

constexpr double kOpenings_mm[] = {1.0, 6.0, 14.0};
constexpr float kTip_mm = 3.0f, kBeak_mm = 14.0f;  // what lies before this z

// Clear width between the tips.
double openingOf(const MeshModel& model) {
  double right_mm = 1e9, left_mm = 1e9;
  for (const glm::vec3& p : tests::partNamed(model, "Right half").position_mm)
    if (p.z < kTip_mm) right_mm = std::min<double>(right_mm, p.x);
  for (const glm::vec3& p : tests::partNamed(model, "Left half").position_mm)
    if (p.z < kTip_mm) left_mm = std::min<double>(left_mm, -p.x);
  return right_mm + left_mm;
}

// Where a line along x from the middle plane enters the right half.
double innerFace(const MeshPart& right, double y_mm, double z_mm) {
  double x_mm = 0.0;
  while (x_mm < 20.0 && test::windingNumber(right, {x_mm, y_mm, z_mm}) < 0.5) x_mm += 0.01;
  return x_mm;
}

TEST(Forceps, AreMadeOfClosedSurfacesWithoutHandles) {
  for (const double opening_mm : kOpenings_mm)
    for (const MeshPart& part : forceps(opening_mm).parts) {
      EXPECT_EQ(test::opennessOf(part.triangles), "") << part.name;
      EXPECT_EQ(test::eulerCharacteristic(part.triangles), 2) << part.name;
      EXPECT_GT(test::volume(part), 0.0) << part.name;
    }
}

TEST(Forceps, HaveFiniteUnitNormalsThatFollowTheirFaces) {
  for (const MeshPart& part : forceps(6.0).parts) {
    ASSERT_EQ(part.normal.size(), part.position_mm.size());
    for (const glm::vec3& p : part.position_mm) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << part.name;
    for (const glm::vec3& n : part.normal) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << part.name;
    if (part.name == "Slot") continue;  // its edges are sharp
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t c) { return dvec3(part.position_mm[part.triangles[t + c]]); };
      const dvec3 area = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      if (glm::length(area) < 1e-4) continue;
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_GT(glm::dot(glm::normalize(area), dvec3(part.normal[part.triangles[t + c]])), 0.3)
            << part.name << " at " << corner(c).x << " " << corner(c).y << " " << corner(c).z;
    }
  }
}

TEST(Forceps, OpenAsAskedWithinTheirLimits) {
  for (const double opening_mm : kOpenings_mm) EXPECT_NEAR(openingOf(forceps(opening_mm)), opening_mm, 1e-4);
  EXPECT_NEAR(openingOf(forceps(-5.0)), kLeastForcepsOpening_mm, 1e-4);
  EXPECT_NEAR(openingOf(forceps(50.0)), kMostForcepsOpening_mm, 1e-4);
  EXPECT_NEAR(openingOf(forceps(std::numeric_limits<double>::quiet_NaN())), kLeastForcepsOpening_mm, 1e-4);
}

TEST(Forceps, HoldTheOriginBetweenTheirTipsAndLeaveItFree) {
  for (const double opening_mm : kOpenings_mm) {
    const MeshModel model = forceps(opening_mm);
    double lowest_mm = 1e9;
    for (const MeshPart& part : model.parts)
      for (const dvec3 p : part.position_mm) {
        EXPECT_GT(glm::length(p), std::max(0.3, 0.45 * opening_mm)) << part.name;
        lowest_mm = std::min(lowest_mm, p.z);
      }
    EXPECT_NEAR(lowest_mm, -1.5, 1.5);
  }
}

TEST(Forceps, HaveTheSizeOfLowerMolarForceps) {
  const MeshModel model = forceps(6.0);
  dvec3 low(1e9), high(-1e9);
  float tip_low_mm = 1e9f, tip_high_mm = -1e9f;
  std::size_t triangles = 0;
  for (const MeshPart& part : model.parts) {
    triangles += part.triangles.size() / 3;
    for (const glm::vec3& p : part.position_mm) {
      low = glm::min(low, dvec3(p)), high = glm::max(high, dvec3(p));
      if (p.z > 1.0f) continue;
      tip_low_mm = std::min(tip_low_mm, p.y), tip_high_mm = std::max(tip_high_mm, p.y);
    }
  }
  EXPECT_EQ(triangles, 5712u);
  EXPECT_GE(tip_high_mm - tip_low_mm, 3.0f);
  EXPECT_LE(tip_high_mm - tip_low_mm, 4.0f);
  EXPECT_NEAR(high.x - low.x, 39.0, 3.0);
  // The handles: 110 to 120 mm from the joint, 20 degrees from the beaks.
  const double along_mm = high.z - 25.0, aside_mm = -low.y - 4.9;
  EXPECT_NEAR(std::hypot(along_mm, aside_mm), 117.0, 5.0);
  EXPECT_NEAR(std::atan2(aside_mm, along_mm), 0.35, 0.06);
  // The joint, 25 mm behind the tips.
  dvec3 screw(0.0);
  const MeshPart& part = tests::partNamed(model, "Screw");
  for (const dvec3 p : part.position_mm) screw += p / static_cast<double>(part.position_mm.size());
  EXPECT_NEAR(screw.x, 0.0, 1e-4);
  EXPECT_NEAR(screw.z, 25.0, 0.1);
}

TEST(Forceps, HaveSymmetricBeaksHollowInside) {
  const MeshModel model = forceps(6.0);
  const MeshPart &right = tests::partNamed(model, "Right half"), &left = tests::partNamed(model, "Left half");
  int compared = 0;
  for (const glm::vec3& p : right.position_mm) {
    if (p.z > kBeak_mm) continue;
    const glm::vec3 mirrored(-p.x, p.y, p.z);
    const auto distance = [&](const glm::vec3& q) { return glm::distance(q, mirrored); };
    ASSERT_LT(distance(std::ranges::min(left.position_mm, {}, distance)), 1e-4f);
    ++compared;
  }
  EXPECT_GT(compared, 100);
  // The inner face is farther out in the middle than at both edges.
  for (const double z_mm : {2.0, 6.0, 10.0})
    for (const double y_mm : {-1.5, 1.5}) EXPECT_GT(innerFace(right, -0.2, z_mm), innerFace(right, y_mm, z_mm) + 0.1);
}

TEST(Forceps, HaveHalvesThatPassEachOther) {
  for (const double opening_mm : kOpenings_mm) {
    const MeshModel model = forceps(opening_mm);
    const MeshPart &right = tests::partNamed(model, "Right half"), &left = tests::partNamed(model, "Left half");
    for (const MeshPart* part : {&right, &left})
      for (const dvec3 p : part->position_mm) {
        if (std::abs(p.z - 25.0) > 25.0) continue;
        ASSERT_LT(test::windingNumber(part == &right ? left : right, p), 0.5)
            << part->name << " open " << opening_mm << " at " << p.x << " " << p.y << " " << p.z;
      }
  }
}

}  // namespace
}  // namespace assets
