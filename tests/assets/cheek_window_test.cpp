#include "assets/cheek_window.h"

#include <gtest/gtest.h>

namespace assets {
namespace {

// A wall of triangles 4 mm wide, 40 mm in front of the molar.
MeshModel wall() {
  MeshPart part;
  part.name = "Face";
  constexpr std::uint32_t kSide = 31;
  for (std::uint32_t j = 0; j < kSide; ++j) {
    for (std::uint32_t i = 0; i < kSide; ++i) {
      part.position_mm.emplace_back(4.0f * static_cast<float>(i) - 60.0f, -40.0f, 4.0f * static_cast<float>(j) - 60.0f);
      part.normal.emplace_back(0, -1, 0);
      part.colour.emplace_back(static_cast<float>(i) / kSide, 0, 0, 1);
      if (i + 1 == kSide || j + 1 == kSide) continue;
      const std::uint32_t n = j * kSide + i;
      part.triangles.insert(part.triangles.end(), {n, n + 1, n + kSide + 1, n, n + kSide + 1, n + kSide});
    }
  }
  return {{part}};
}

double area_mm2(const MeshPart& part) {
  double area = 0.0;
  for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(part.position_mm[part.triangles[t + i]]); };
    area += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  return area;
}

const OperatingSite kSite{true, 48, {0, 0, 0}, {0, 0, 1}};

TEST(CheekWindow, CutsARoundHoleOfItsOwnSize) {
  const MeshModel cut = withCheekWindow(wall(), kSite, {{0, -2, 0}, 10.0, 0.1});
  const double radius_mm = 10.0 + 0.1 * 40.0;
  EXPECT_NEAR(area_mm2(wall().parts[0]) - area_mm2(cut.parts.at(0)), 3.14159 * radius_mm * radius_mm, 12.0);
  for (const glm::vec3& p : cut.parts[0].position_mm) EXPECT_GT(std::hypot(p.x, p.z), radius_mm - 0.2);
  ASSERT_EQ(cut.parts[0].colour.size(), cut.parts[0].position_mm.size());
  ASSERT_EQ(cut.parts[0].normal.size(), cut.parts[0].position_mm.size());
}

TEST(CheekWindow, LeavesWhatLiesBehindTheMolar) {
  const MeshModel cut = withCheekWindow(wall(), kSite, {{0, 1, 0}, 10.0, 0.1});
  EXPECT_EQ(cut.parts.at(0).triangles.size(), wall().parts[0].triangles.size());
}

TEST(CheekWindow, DropsAPartThatVanishes) {
  EXPECT_TRUE(withCheekWindow(wall(), kSite, {{0, -1, 0}, 200.0, 0.0}).parts.empty());
}

TEST(CheekWindow, IsNotCutWithoutASite) {
  EXPECT_EQ(withCheekWindow(wall(), {}, {}).parts.at(0).triangles, wall().parts[0].triangles);
}

}  // namespace
}  // namespace assets
