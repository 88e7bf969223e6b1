#include "assets/scan/panoramic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace assets {
namespace {

constexpr double kRadius_mm = 25.0, kHalfBar_mm = 2.0;

/// A bar of 1000 HU, 4 mm wide, on a half circle in air, for z above 5 mm.
CtVolume bentBar() {
  CtVolume ct;
  ct.grid = {{140, 80, 41}, 0.5, {-35.0, -35.0, 0.0}};
  ct.hounsfield.assign(ct.grid.voxelCount(), -1000);
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    if (std::abs(std::hypot(p.x, p.y) - kRadius_mm) < kHalfBar_mm && p.z >= 5.0) ct.hounsfield[v] = 1000;
  });
  return ct;
}

std::vector<glm::dvec2> halfCircle() {
  std::vector<glm::dvec2> curve;
  for (int n = 0; n <= 180; ++n) {
    const double a = glm::radians(180.0 + n);
    curve.emplace_back(kRadius_mm * std::cos(a), kRadius_mm * std::sin(a));
  }
  return curve;
}

TEST(Panoramic, ABentBarIsAStraightBandOfItsLengthAndItsShareOfTheLayer) {
  const Panoramic view = panoramicOf(bentBar(), halfCircle(), 0.5, 16.0);
  EXPECT_NEAR(view.size_px.x * view.pixel_mm, M_PI * kRadius_mm, 1.0);
  EXPECT_EQ(view.size_px.y, 40);
  // 4 of 16 mm are bar, the rest is air.
  const auto at = [&](int x, int y) { return view.hounsfield[static_cast<std::size_t>(y * view.size_px.x + x)]; };
  for (int x = 4; x < view.size_px.x - 4; ++x) {
    EXPECT_NEAR(at(x, 5), -500.0, 90.0) << x;
    EXPECT_NEAR(at(x, 38), -1000.0, 1.0) << x;
  }
}

TEST(Panoramic, APointLiesAtItsColumnAndHeightWithItsDistanceFromTheCurve) {
  const Panoramic view = panoramicOf(bentBar(), halfCircle(), 0.5, 16.0);
  for (int n = 10; n < 170; n += 7) {
    const double a = glm::radians(180.0 + n), r = kRadius_mm + (n % 5) - 2.0;
    const auto at = view.positionOf({r * std::cos(a), r * std::sin(a), 8.0});
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->px.x * view.pixel_mm, glm::radians(1.0 * n) * kRadius_mm, 0.5);
    EXPECT_NEAR(at->px.y * view.pixel_mm, view.top_P_mm - 8.0, 1e-9);
    EXPECT_NEAR(at->from_curve_mm, std::abs(r - kRadius_mm), 0.05);
  }
}

TEST(Panoramic, APointBeyondTheEndsIsNotInTheImage) {
  const Panoramic view = panoramicOf(bentBar(), halfCircle(), 0.5, 16.0);
  EXPECT_FALSE(view.positionOf({-kRadius_mm, 12.0, 8.0}));
  EXPECT_TRUE(view.positionOf({-kRadius_mm - 3.0, 0.0, 8.0}));
}

}  // namespace
}  // namespace assets
