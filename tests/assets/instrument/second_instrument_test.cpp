#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "assets/instrument/dental_mirror.h"
#include "assets/instrument/retractor.h"
#include "assets/mesh/closed_sweep.h"
#include "tests/assets/instrument/part_named.h"
#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

using glm::dvec3;

dvec3 corner(const MeshPart& part, std::size_t index) { return part.position_mm[part.triangles[index]]; }

dvec3 areaNormal(const MeshPart& part, std::size_t t) {
  return glm::cross(corner(part, t + 1) - corner(part, t), corner(part, t + 2) - corner(part, t));
}

template <class Measure>
std::pair<double, double> rangeOf(const MeshModel& model, Measure measure) {
  double least = 1e9, most = -1e9;
  for (const MeshPart& part : model.parts)
    for (const dvec3 p : part.position_mm) {
      least = std::min(least, measure(p));
      most = std::max(most, measure(p));
    }
  return {least, most};
}

bool isInside(const std::vector<MeshPart>& parts, const MeshPart& but, const dvec3& p) {
  return std::ranges::any_of(
      parts, [&](const MeshPart& part) { return part.name != but.name && test::windingNumber(part, p) > 0.5; });
}

// The sharpest bend of the surface along any edge that no other part covers, of triangles that have an area; 46 if
// less.
double sharpestEdge_deg(const MeshPart& part, const std::vector<MeshPart>& parts) {
  std::map<test::Edge, dvec3> normal;
  for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
    const dvec3 area = areaNormal(part, t);
    if (glm::length(area) < 1e-7) continue;
    for (std::size_t c = 0; c < 3; ++c)
      normal[{part.triangles[t + c], part.triangles[t + (c + 1) % 3]}] = glm::normalize(area);
  }
  double sharpest_deg = 46.0;
  for (const auto& [edge, n] : normal) {
    const auto other = normal.find({edge.second, edge.first});
    if (other == normal.end()) continue;
    const double bend_deg = std::acos(std::clamp(glm::dot(n, other->second), -1.0, 1.0)) * 180.0 / M_PI;
    const dvec3 middle = 0.5f * (part.position_mm[edge.first] + part.position_mm[edge.second]);
    if (bend_deg > sharpest_deg && !isInside(parts, part, middle)) sharpest_deg = bend_deg;
  }
  return sharpest_deg;
}

std::vector<MeshPart> allParts() {
  std::vector<MeshPart> parts = dentalMirror().parts;
  for (const MeshPart& part : retractor().parts) parts.push_back(part);
  return parts;
}

TEST(ClosedSweep, OfCirclesIsTheCylinderTheyBound) {
  const std::vector<Ring> rings{circle({0, 0, -3}, {0, 0, 1}, 2.0, 400), circle({0, 0, 5}, {0, 0, 1}, 2.0, 400)};
  const MeshPart part = closedSweep(rings);
  EXPECT_EQ(test::opennessOf(part.triangles), "");
  EXPECT_NEAR(test::volume(part), M_PI * 4.0 * 8.0, 0.01);
}

TEST(SecondInstrument, IsMadeOfClosedSurfacesWithoutHandles) {
  for (const MeshPart& part : allParts()) {
    EXPECT_EQ(test::opennessOf(part.triangles), "") << part.name;
    EXPECT_EQ(test::eulerCharacteristic(part.triangles), 2) << part.name;
    EXPECT_GT(test::volume(part), 0.0) << part.name;
  }
}

TEST(SecondInstrument, HasUnitNormalsThatFollowItsFaces) {
  // Except where another part covers them.
  const std::vector<MeshPart> parts = allParts();
  for (const MeshPart& part : parts) {
    ASSERT_EQ(part.normal.size(), part.position_mm.size());
    for (const glm::vec3& n : part.normal) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f);
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      const dvec3 area = areaNormal(part, t);
      if (glm::length(area) < 1e-4) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const double along = glm::dot(glm::normalize(area), dvec3(part.normal[part.triangles[t + c]]));
        ASSERT_TRUE(along > 0.7 || isInside(parts, part, corner(part, t + c))) << part.name << " " << along;
      }
    }
  }
}

TEST(SecondInstrument, HasNoSharpEdge) {
  const std::vector<MeshPart> parts = allParts();
  for (const MeshPart& part : parts) EXPECT_EQ(sharpestEdge_deg(part, parts), 46.0) << part.name;
}

TEST(DentalMirror, IsAsWideAsANumberFive) {
  const MeshModel model = dentalMirror();
  double widest_mm = 0.0;
  for (const dvec3 p : tests::partNamed(model, "Casing").position_mm) {
    EXPECT_LT(glm::length(p), 12.2);
    widest_mm = std::max(widest_mm, std::abs(p.x));
  }
  EXPECT_NEAR(2.0 * widest_mm, 24.0, 0.02);
  const auto [low, high] = rangeOf(model, [](const dvec3& p) { return p.z; });
  EXPECT_GT(high - low, 150.0);
  EXPECT_LE(high - low, 173.0);
}

TEST(DentalMirror, HasItsGlassAtTheOriginAt45DegreesToTheHandle) {
  const MeshModel model = dentalMirror();
  const dvec3 out = glm::normalize(dvec3(0, -1, 1));
  // The face of the glass: flat, through the origin, all around it.
  double face_mm2 = 0.0;
  const MeshPart& glass = tests::partNamed(model, "Glass");
  for (std::size_t t = 0; t < glass.triangles.size(); t += 3) {
    const dvec3 area = areaNormal(glass, t);
    if (glm::dot(area, out) < 0.999 * glm::length(area) || glm::length(area) == 0.0) continue;
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(glm::dot(corner(glass, t + c), out), 0.0, 1e-5);
    face_mm2 += 0.5 * glm::length(area);
  }
  EXPECT_NEAR(face_mm2, M_PI * 11.0 * 11.0, 5.0);
  for (const dvec3 p : glass.position_mm) EXPECT_LT(glm::dot(p, out), 1e-5);

  // Only the rim is in front of it.
  for (const char* name : {"Casing", "Stem", "Handle"})
    for (const dvec3 p : tests::partNamed(model, name).position_mm)
      EXPECT_TRUE(glm::length(p - glm::dot(p, out) * out) > 10.8 || glm::dot(p, out) < 0.0) << name;

  // The handle runs along z.
  dvec3 low(1e9), high(-1e9);
  for (const dvec3 p : tests::partNamed(model, "Handle").position_mm) low = glm::min(low, p), high = glm::max(high, p);
  EXPECT_NEAR(high.x - low.x, 7.0, 0.05);
  EXPECT_NEAR(high.y - low.y, 7.0, 0.05);
  EXPECT_GT(high.z - low.z, 100.0);
}

TEST(DentalMirror, IsConnected) {
  const MeshModel model = dentalMirror();
  // One point of the stem lies in the casing, another in the handle.
  int in_casing = 0, in_handle = 0;
  const MeshPart& stem = tests::partNamed(model, "Stem");
  for (std::size_t v = 0; v < stem.position_mm.size(); v += 4) {
    const dvec3 p = stem.position_mm[v];
    in_casing += test::windingNumber(tests::partNamed(model, "Casing"), p) > 0.5 ? 1 : 0;
    in_handle += test::windingNumber(tests::partNamed(model, "Handle"), p) > 0.5 ? 1 : 0;
  }
  EXPECT_GE(in_casing, 5);
  EXPECT_GE(in_handle, 5);
}

TEST(Retractor, HasItsTipAtTheOriginAndItsHandleAlongZ) {
  const MeshModel model = retractor();
  const MeshPart& part = model.parts.front();
  double nearest_mm = 1e9;
  for (const dvec3 p : part.position_mm) nearest_mm = std::min(nearest_mm, glm::length(p));
  EXPECT_LT(nearest_mm, 0.2);
  const auto [left, right] = rangeOf(model, [](const dvec3& p) { return p.x; });
  EXPECT_NEAR(left, -right, 1e-4);
  EXPECT_NEAR(right - left, 14.5, 1.0);
  const auto [low, high] = rangeOf(model, [](const dvec3& p) { return p.z; });
  EXPECT_GT(low, -2.5);
  EXPECT_NEAR(high, 138.0, 2.0);
  // Straight along z from 50 to 100 mm.
  for (const dvec3 p : part.position_mm) EXPECT_TRUE(p.z < 50.0 || p.z > 100.0 || std::abs(p.y - 30.5) < 2.5) << p.y;
}

TEST(Retractor, IsAThinBlade) {
  const MeshPart part = retractor().parts.front();
  // Mean thickness: volume over half the surface.
  EXPECT_NEAR(test::volume(part) / (0.5 * test::area(part)), kRetractorThickness_mm, 0.2);
}

}  // namespace
}  // namespace assets
