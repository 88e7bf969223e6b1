#include "app/case/arch_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/tooth.h"

namespace app {
namespace {

double distanceTo(const std::vector<glm::dvec2>& curve, const glm::dvec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::dvec2& c : curve) nearest = std::min(nearest, glm::distance(c, p));
  return nearest;
}

/// On a parabola, at the centre of a voxel.
glm::dvec2 placeOf(int fdi) {
  const double x = (assets::isRight(fdi) ? -1.0 : 1.0) * (3.6 * assets::positionOf(fdi) - 1.5);
  return {std::round(x), std::round(0.06 * x * x)};
}

/// Teeth as balls of 1.4 mm radius.
assets::Patient jawWithTeeth(const std::vector<int>& teeth) {
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {{90, 80, 12}, 1.0, {-45.0, -5.0, -6.0}};
  ct.tooth.assign(ct.grid.voxelCount(), 0);
  for (const int fdi : teeth) {
    const glm::dvec3 centre{placeOf(fdi), 0.0};
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (glm::distance(ct.grid.centre_P_mm(ijk), centre) < 1.4) ct.tooth[v] = static_cast<std::uint8_t>(fdi);
    });
  }
  return patient;
}

TEST(ArchCurve, GoesThroughTheTeethFromRightToLeft) {
  const std::vector<int> teeth{47, 46, 44, 43, 41, 31, 33, 35, 36, 37};
  const assets::Patient patient = jawWithTeeth(teeth);
  const std::vector<glm::dvec2> curve = archCurve_P_mm(patient);
  ASSERT_GT(curve.size(), 100U);
  EXPECT_LT(curve.front().x, curve.back().x);
  for (const int fdi : teeth) EXPECT_LT(distanceTo(curve, placeOf(fdi)), 0.01) << fdi;
  for (std::size_t n = 0; n + 1 < curve.size(); ++n) EXPECT_LT(glm::distance(curve[n], curve[n + 1]), 0.8);
}

TEST(ArchCurve, TeethOfTheOtherArchDoNotCount) {
  std::vector<int> teeth{46, 44, 43, 33, 35, 36};
  const std::vector<glm::dvec2> lower = archCurve_P_mm(jawWithTeeth(teeth));
  teeth.push_back(11);
  teeth.push_back(18);
  EXPECT_EQ(archCurve_P_mm(jawWithTeeth(teeth)), lower);
}

TEST(ArchCurve, StaysInTheVolume) {
  const assets::Patient patient = jawWithTeeth({47, 46, 45, 44});
  for (const glm::dvec2& p : archCurve_P_mm(patient)) {
    EXPECT_GE(p.x, -45.0);
    EXPECT_LE(p.x, 44.0);
    EXPECT_GE(p.y, -5.0);
    EXPECT_LE(p.y, 74.0);
  }
}

TEST(ArchCurve, IsEmptyWithoutTeethAndSite) { EXPECT_TRUE(archCurve_P_mm(jawWithTeeth({})).empty()); }

}  // namespace
}  // namespace app
