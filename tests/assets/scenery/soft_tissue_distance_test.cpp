#include "assets/scenery/soft_tissue_distance.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"

namespace assets {
namespace {

constexpr double kRadius_mm = 9.0;

/// A closed ball of triangles, counter-clockwise from outside.
MeshPart ballPart(const std::string& name, const glm::dvec3& centre_mm, double radius_mm) {
  constexpr unsigned kRings = 40, kAround = 80;
  MeshPart part;
  part.name = name;
  const auto put = [&](double polar, double azimuth) {
    part.position_mm.emplace_back(centre_mm + radius_mm * glm::dvec3(std::sin(polar) * std::cos(azimuth),
                                                                     std::sin(polar) * std::sin(azimuth),
                                                                     std::cos(polar)));
  };
  put(0.0, 0.0);
  for (unsigned ring = 1; ring < kRings; ++ring)
    for (unsigned n = 0; n < kAround; ++n) put(calibration::kPi * ring / kRings, 2.0 * calibration::kPi * n / kAround);
  put(calibration::kPi, 0.0);
  const auto at = [&](unsigned ring, unsigned n) {
    return ring == 0 ? 0u : ring == kRings ? (kRings - 1) * kAround + 1 : 1 + (ring - 1) * kAround + n % kAround;
  };
  for (unsigned ring = 0; ring < kRings; ++ring)
    for (unsigned n = 0; n < kAround; ++n) {
      if (ring > 0) part.triangles.insert(part.triangles.end(), {at(ring, n), at(ring + 1, n), at(ring, n + 1)});
      if (ring + 1 < kRings)
        part.triangles.insert(part.triangles.end(), {at(ring, n + 1), at(ring + 1, n), at(ring + 1, n + 1)});
    }
  return part;
}

const SoftTissueRegion kEverywhere{glm::dvec3(0.0), 100.0};

TEST(SoftTissueSurface, KnowsTheTissueByTheNameOfThePart) {
  const MeshModel gum{{ballPart("Gingiva", glm::dvec3(0.0), 2.0), ballPart("Flap", {20.0, 0.0, 0.0}, 2.0)}};
  MeshModel face{{ballPart("Tongue", {0.0, 20.0, 0.0}, 2.0), ballPart("Teeth upper", {0.0, 0.0, 20.0}, 2.0)}};
  face.parts.push_back(ballPart("Tongue retractor", {0.0, 30.0, 0.0}, 2.0));
  face.parts.back().material.metallic = 1.0f;
  const auto surfaces = softTissueSurfaces(gum, face, kEverywhere);
  ASSERT_EQ(surfaces.size(), 2u) << "teeth and metal are none";
  EXPECT_EQ(surfaces[0].tissue.front(), SoftTissue::gingiva);
  EXPECT_EQ(surfaces[0].tissue.back(), SoftTissue::flap);
  EXPECT_EQ(surfaces[1].tissue.front(), SoftTissue::tongue);
}

TEST(SoftTissueField, IsTheDistanceToABallInClosedForm) {
  const auto surfaces = softTissueSurfaces({{ballPart("Gingiva", glm::dvec3(0.0), kRadius_mm)}}, {}, kEverywhere);
  const SoftTissueField field = softTissueField(surfaces, kEverywhere);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-16.0, 16.0);
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 p(any(random), any(random), any(random));
    const double exact_mm =
        glm::clamp(glm::length(p) - kRadius_mm, -SoftTissueField::kInside_mm, SoftTissueField::kOutside_mm);
    EXPECT_NEAR(field.at(p).distance_mm, exact_mm, exact_mm > -2.5 && exact_mm < 8.0 ? 0.2 : 0.4) << glm::length(p);
  }
}

/// At the voxels' centres, against every triangle asked.
TEST(SoftTissueField, EqualsItsSlowTwin) {
  const MeshModel gum{{ballPart("Gingiva", glm::dvec3(0.0), 6.0), ballPart("Flap", {16.0, 3.0, -4.0}, 5.0)}};
  const auto surfaces = softTissueSurfaces(gum, {{ballPart("Tongue", {-9.0, 3.0, 2.0}, 7.0)}}, kEverywhere);
  ASSERT_EQ(surfaces.size(), 2u);
  const SoftTissueField field = softTissueField(surfaces, kEverywhere);
  std::mt19937 random(6);
  int near = 0;
  for (int n = 0; n < 400; ++n) {
    const auto below = [&](int size) { return static_cast<int>(random() % static_cast<unsigned>(size)); };
    const glm::ivec3 at(below(field.grid.size.x), below(field.grid.size.y), below(field.grid.size.z));
    const std::size_t voxel = field.grid.index(at);
    const glm::dvec3 p = field.grid.centre_P_mm(at);
    SoftTissueNearest twin = nearestOf(surfaces[0], p);
    if (const SoftTissueNearest other = nearestOf(surfaces[1], p); other.distance_mm < twin.distance_mm) twin = other;
    if (twin.distance_mm > 9.0) {
      EXPECT_GT(field.distance[voxel], SoftTissueField::stored(8.7));
      continue;
    }
    const double exact_mm = std::max(twin.distance_mm, -SoftTissueField::kInside_mm);
    EXPECT_NEAR(field.distance[voxel] / SoftTissueField::kPerMm, exact_mm, std::abs(exact_mm) < 3.0 ? 0.1 : 0.25);
    if (std::abs(twin.distance_mm) > 3.0) continue;
    ++near;
    EXPECT_EQ(SoftTissue{field.tissue[voxel]}, twin.tissue);
  }
  EXPECT_GT(near, 15);
}

TEST(SoftTissueField, OfNothingIsEmptyAndFarFromEverything) {
  const SoftTissueField field = softTissueField(softTissueSurfaces({}, {}, kEverywhere), kEverywhere);
  EXPECT_TRUE(field.isEmpty());
  EXPECT_EQ(field.at(glm::dvec3(0.0)).distance_mm, SoftTissueField::kOutside_mm);
  EXPECT_EQ(field.tissueAt(glm::dvec3(0.0)), SoftTissue::none);
}

}  // namespace
}  // namespace assets
