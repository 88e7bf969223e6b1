#include "assets/instrument/handpiece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "assets/load_error.h"
#include "tests/assets/instrument/part_named.h"

namespace assets {
namespace {

// Vertices in front of the neck.
std::vector<glm::dvec3> headVertices(const MeshPart& bur, double radius_mm) {
  std::vector<glm::dvec3> out;
  for (const glm::vec3& p : bur.position_mm) {
    if (p.z < 0.5 * radius_mm) out.emplace_back(p);
  }
  return out;
}

TEST(Handpiece, BladesReachExactlyTheRadiusOfTheBur) {
  for (const double radius_mm : {0.5, 1.0, 2.0, 4.0}) {
    const MeshModel model = surgicalHandpiece({.bur_radius_mm = radius_mm});
    double furthest_mm = 0.0;
    for (const glm::dvec3& p : headVertices(tests::partNamed(model, "Bur"), radius_mm)) {
      furthest_mm = std::max(furthest_mm, glm::length(p));
    }
    EXPECT_NEAR(furthest_mm, radius_mm, 1e-5);
  }
}

TEST(Handpiece, HasOneBladeAFlute) {
  const double radius_mm = 2.0;
  const MeshModel model = surgicalHandpiece({.bur_radius_mm = radius_mm, .flutes = 12});
  // Count the rises from gullet to blade around the equator.
  std::map<double, bool> on_blade;
  const std::vector<glm::dvec3> head = headVertices(tests::partNamed(model, "Bur"), radius_mm);
  const auto sine = [](const glm::dvec3& p) { return std::abs(p.z) / glm::length(p); };
  const double equator = sine(*std::ranges::min_element(head, {}, sine)) + 1e-4;
  for (const glm::dvec3& p : head) {
    if (sine(p) <= equator) on_blade[std::atan2(p.y, p.x)] = glm::length(p) > 0.97 * radius_mm;
  }
  int rises = 0;
  bool before = on_blade.rbegin()->second;
  for (const auto& [turn, blade] : on_blade) {
    rises += blade && !before ? 1 : 0;
    before = blade;
  }
  EXPECT_EQ(rises, 12);
}

TEST(Handpiece, LiesAlongTheShaft) {
  const MeshModel model = surgicalHandpiece({});
  double low_mm = 1e9;
  double high_mm = -1e9;
  for (const MeshPart& part : model.parts) {
    for (const glm::vec3& p : part.position_mm) {
      low_mm = std::min<double>(low_mm, p.z);
      high_mm = std::max<double>(high_mm, p.z);
      EXPECT_LT(std::hypot(p.x, p.y), 9.0f);
    }
  }
  EXPECT_NEAR(low_mm, -2.0, 1e-5);
  EXPECT_NEAR(high_mm, 110.0, 1.0);
}

TEST(Handpiece, FacesOutward) {
  // The signed volume of a surface wound outward is positive, and normals point away from the axis.
  std::vector<MeshPart> parts = surgicalHandpiece({}).parts;
  for (const BurForm form : {BurForm::capsule, BurForm::cylinder, BurForm::cone})
    parts.push_back(surgicalHandpiece({.form = form, .bur_length_mm = 4.0}).parts.front());
  for (const MeshPart& part : parts) {
    double volume_mm3 = 0.0;
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t i) { return glm::dvec3(part.position_mm[part.triangles[t + i]]); };
      volume_mm3 += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
    }
    EXPECT_GT(volume_mm3, 0.0) << part.name;
    ASSERT_EQ(part.normal.size(), part.position_mm.size());
    for (const glm::vec3& n : part.normal) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f);
  }
}

TEST(Handpiece, BladesFollowTheOutlineOfEveryRevolvedHead) {
  const double radius_mm = 0.8, length_mm = 4.0;
  for (std::size_t n = 0; n < kBurProfiles; ++n) {
    const auto profile = static_cast<BurProfile>(n);
    const BurOutline outline = burOutline(profile, radius_mm, length_mm);
    const MeshModel model = surgicalHandpiece({.bur_radius_mm = radius_mm,
                                               .form = BurForm::revolved,
                                               .bur_length_mm = length_mm,
                                               .profile = profile,
                                               .neck_radius_mm = 0.3});
    double widest_mm = 0.0, lowest_mm = 0.0, farthest_out_mm = -1.0, nearest_mm = -1.0;
    for (const glm::dvec3 p : tests::partNamed(model, "Bur").position_mm) {
      if (p.z > 0.8) continue;  // the egg's neck
      const double distance_mm = outlineDistance_mm(outline, std::hypot(p.x, p.y), p.z);
      widest_mm = std::max(widest_mm, std::hypot(p.x, p.y));
      lowest_mm = std::min(lowest_mm, p.z);
      farthest_out_mm = std::max(farthest_out_mm, distance_mm);
      if (std::abs(p.z) < 0.8) nearest_mm = std::max(nearest_mm, distance_mm);
    }
    EXPECT_LT(widest_mm, radius_mm + 1e-5);
    EXPECT_NEAR(lowest_mm, -0.5 * length_mm, 1e-5) << kBurProfileKeys[n];
    EXPECT_LT(farthest_out_mm, 1e-5) << kBurProfileKeys[n];
    EXPECT_NEAR(nearest_mm, 0.0, 1e-5) << kBurProfileKeys[n];
  }
}

TEST(Handpiece, BladesFollowTheOutlineOfEveryShape) {
  const double radius_mm = 0.8, length_mm = 4.0, half_mm = 0.5 * length_mm;
  for (const BurForm form : {BurForm::capsule, BurForm::cylinder, BurForm::cone}) {
    const MeshModel model = surgicalHandpiece(
        {.bur_radius_mm = radius_mm, .form = form, .bur_length_mm = length_mm, .neck_radius_mm = 0.4});
    double widest_mm = 0.0, lowest_mm = 0.0, farthest_out_mm = -1.0, nearest_mm = -1.0;
    for (const glm::dvec3 p : tests::partNamed(model, "Bur").position_mm) {
      if (p.z > half_mm) continue;
      const double rho = std::hypot(p.x, p.y);
      const double outline = form == BurForm::cone ? radius_mm * (p.z + half_mm) / length_mm
                             : form == BurForm::capsule && p.z < -half_mm
                                 ? std::sqrt(std::max(0.0, radius_mm * radius_mm - std::pow(p.z + half_mm, 2)))
                                 : radius_mm;
      widest_mm = std::max(widest_mm, rho);
      lowest_mm = std::min(lowest_mm, p.z);
      farthest_out_mm = std::max(farthest_out_mm, rho - outline);
      if (std::abs(p.z) < 1.0) nearest_mm = std::max(nearest_mm, rho / outline);
    }
    EXPECT_NEAR(widest_mm, radius_mm, 1e-5);
    EXPECT_NEAR(lowest_mm, form == BurForm::capsule ? -half_mm - radius_mm : -half_mm, 1e-5);
    EXPECT_LT(farthest_out_mm, 1e-5);
    EXPECT_NEAR(nearest_mm, 1.0, 1e-5);
  }
}

TEST(Handpiece, RefusesInvalidParameters) {
  EXPECT_THROW(surgicalHandpiece({.form = BurForm::cone, .bur_length_mm = 0.0}), LoadError);
  EXPECT_THROW(surgicalHandpiece({.form = BurForm::cylinder, .bur_length_mm = 30.0}), LoadError);
  EXPECT_THROW(surgicalHandpiece({.bur_radius_mm = 0.0}), LoadError);
  EXPECT_THROW(surgicalHandpiece({.bur_radius_mm = std::nan("")}), LoadError);
  EXPECT_THROW(surgicalHandpiece({.bur_radius_mm = 2.0, .flutes = 4}), LoadError);
}

}  // namespace
}  // namespace assets
