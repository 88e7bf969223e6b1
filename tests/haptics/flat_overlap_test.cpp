#include "haptics/tool/flat_overlap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <glm/glm.hpp>

#include "calibration/geometry/units.h"
#include "haptics/contact/cap.h"

namespace haptics {
namespace {

using calibration::kPi;

const std::vector<BurShape> kShapes = {{ShapeKind::capsule, 0.8, 3.0},  {ShapeKind::cylinder, 0.6, 4.0},
                                       {ShapeKind::cylinder, 2.0, 0.5}, {ShapeKind::cone, 1.0, 3.0},
                                       {ShapeKind::cone, 2.0, 0.7},     {ShapeKind::sphere, 1.5, 0.0}};
const std::vector<double> kAngles_deg = {0.0, 0.5, 10.0, 45.0, 80.0, 91.0, 120.0, 165.0, 179.5, 180.0};

/// Gauss-Legendre with eight points.
template <class F>
void integrate(double from, double to, F add) {
  constexpr std::array<double, 4> kNode = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                           0.9602898564975363};
  constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                             0.1012285362903763};
  for (std::size_t i = 0; i < 4; ++i)
    for (const double side : {-1.0, 1.0})
      add(0.5 * (from + to) + 0.5 * side * kNode[i] * (to - from), 0.5 * kWeight[i] * (to - from));
}

/// The shared part as columns parallel to the axis, on circles rho = R sin(a): midpoints in a, and in the turn pieces
/// between the places where the face leaves the column at its lower and its upper end.
FlatOverlap byColumns(const BurShape& shape, double depth, double angle_deg) {
  const double angle = calibration::radFromDegrees(angle_deg), cos = std::cos(angle), sin = std::sin(angle);
  const double R = shape.radius_mm, half = 0.5 * shape.length_mm, level = depth - reach_mm(shape, -cos);
  double volume = 0.0, across = 0.0, along = 0.0;
  constexpr int kCircles = 4000;
  for (int i = 0; i < kCircles; ++i) {
    const double a = 0.5 * kPi * (i + 0.5) / kCircles, rho = R * std::sin(a), cap = R * std::cos(a);
    double low = -half, high = half;
    if (shape.kind == ShapeKind::sphere) low = -cap, high = cap;
    if (shape.kind == ShapeKind::capsule) low = -half - cap, high = half + cap;
    if (shape.kind == ShapeKind::cone) low = -half + shape.length_mm * rho / R;
    const auto turnAt = [&](double z) {
      const double x = level - z * cos, most = rho * sin;
      return std::abs(x) < most ? std::acos(x / most) : (x > 0.0 ? 0.0 : kPi);
    };
    const double first = std::min(turnAt(low), turnAt(high)), second = std::max(turnAt(low), turnAt(high));
    const std::array<double, 4> turn = {0.0, first, second, kPi};
    for (std::size_t n = 0; n < 3; ++n)
      integrate(turn[n], turn[n + 1], [&](double phi, double weight) {
        const double x = rho * std::cos(phi), face = std::clamp((level - x * sin) / cos, low, high);
        const double from = cos > 0.0 ? low : face, to = cos > 0.0 ? face : high;
        const double column = (to - from) * 2.0 * weight * rho * cap * 0.5 * kPi / kCircles;
        volume += column;
        across += column * x;
        along += column * 0.5 * (from + to);
      });
  }
  return {volume, 0.0, across / volume, along / volume};
}

TEST(FlatOverlap, IsTheSumOfItsColumnsToAMillionth) {
  for (const BurShape& shape : kShapes)
    for (const double angle : kAngles_deg) {
      const double cos = std::cos(calibration::radFromDegrees(angle));
      for (const double part : {0.05, 0.3, 0.7}) {
        const double depth = part * fullDepth_mm(shape, cos);
        const FlatOverlap fast = flatOverlap(shape, depth, cos), slow = byColumns(shape, depth, angle);
        const double size = volume_mm3(shape);
        EXPECT_NEAR(fast.volume_mm3, slow.volume_mm3, 1e-6 * size) << angle << "° " << depth;
        EXPECT_NEAR(fast.centroid_across_mm * fast.volume_mm3, slow.centroid_across_mm * slow.volume_mm3,
                    1e-6 * size * shape.radius_mm);
        EXPECT_NEAR(fast.centroid_along_mm * fast.volume_mm3, slow.centroid_along_mm * slow.volume_mm3,
                    1e-6 * size * (1.0 + shape.length_mm));
      }
    }
}

TEST(FlatOverlap, IsTheCapForARoundHead) {
  // A capsule without a rod is summed slice by slice; the sphere's cap is a closed form.
  const BurShape round{ShapeKind::capsule, 2.0, 0.0}, sphere{ShapeKind::sphere, 2.0, 0.0};
  for (const double angle : kAngles_deg)
    for (const double h : {0.01, 0.2, 1.0, 2.0, 3.3, 3.99}) {
      const double cos = std::cos(calibration::radFromDegrees(angle));
      for (const BurShape& shape : {round, sphere}) {
        const FlatOverlap cap = flatOverlap(shape, h, cos);
        EXPECT_NEAR(cap.volume_mm3, capVolume_mm3(2.0, h), 1e-8 * capVolume_mm3(2.0, 4.0)) << angle << ' ' << h;
        const glm::dvec2 centroid{cap.centroid_across_mm, cap.centroid_along_mm};
        EXPECT_NEAR(glm::length(centroid) * cap.volume_mm3, capMoment_mm4(2.0, h), 1e-7);
        EXPECT_NEAR(cap.area_mm2, kPi * h * (4.0 - h), 1e-7);
      }
    }
}

TEST(FlatOverlap, HasTheClosedFormsOfSideAndEnd) {
  const double R = 0.6, L = 4.0, h = 0.25, u = R - h;
  const double segment = R * R * std::acos(u / R) - u * std::sqrt(R * R - u * u);
  const FlatOverlap side = flatOverlap({ShapeKind::cylinder, R, L}, h, 0.0);
  EXPECT_NEAR(side.volume_mm3, L * segment, 1e-9);
  EXPECT_NEAR(side.area_mm2, L * 2.0 * std::sqrt(R * R - u * u), 1e-9);
  EXPECT_NEAR(side.centroid_along_mm, 0.0, 1e-12);
  const FlatOverlap capsule = flatOverlap({ShapeKind::capsule, R, L}, h, 0.0);
  EXPECT_NEAR(capsule.volume_mm3, L * segment + capVolume_mm3(R, h), 1e-8);
  const FlatOverlap end = flatOverlap({ShapeKind::cylinder, R, L}, h, 1.0);
  EXPECT_NEAR(end.volume_mm3, kPi * R * R * h, 1e-12);
  EXPECT_NEAR(end.centroid_along_mm, -0.5 * L + 0.5 * h, 1e-12);
  const FlatOverlap tip = flatOverlap({ShapeKind::cone, R, L}, h, 1.0);
  EXPECT_NEAR(tip.volume_mm3, kPi / 3.0 * std::pow(R * h / L, 2) * h, 1e-12);
  EXPECT_NEAR(tip.centroid_along_mm, -0.5 * L + 0.75 * h, 1e-12);
}

TEST(FlatOverlap, GrowsByItsAreaWithDepth) {
  for (const BurShape& shape : kShapes)
    for (const double angle : kAngles_deg) {
      const double cos = std::cos(calibration::radFromDegrees(angle)), whole = fullDepth_mm(shape, cos);
      for (double part = 0.013; part < 1.0; part += 0.09) {
        const double h = part * whole, step = 1e-5 * whole;
        const double slope =
            (flatOverlap(shape, h + step, cos).volume_mm3 - flatOverlap(shape, h - step, cos).volume_mm3) /
            (2.0 * step);
        EXPECT_NEAR(flatOverlap(shape, h, cos).area_mm2, slope, 1e-4 * volume_mm3(shape) / whole)
            << angle << ' ' << part;
      }
    }
}

TEST(FlatDepth, FindsTheDepthOfAVolume) {
  for (const BurShape& shape : kShapes)
    for (const double angle : kAngles_deg) {
      const double cos = std::cos(calibration::radFromDegrees(angle)), whole = fullDepth_mm(shape, cos);
      for (double part = 0.004; part < 1.0; part += 0.037) {
        const double h = part * whole, volume = flatOverlap(shape, h, cos).volume_mm3;
        // Where the face grazes the head the volume hardly tells the depth.
        if (volume < 1e-7 * volume_mm3(shape) || volume > (1.0 - 1e-7) * volume_mm3(shape)) continue;
        EXPECT_NEAR(flatDepth_mm(shape, volume, cos), h, 1e-6 * whole)
            << angle << "° of " << static_cast<int>(shape.kind);
      }
      EXPECT_EQ(flatDepth_mm(shape, 0.0, cos), 0.0);
      EXPECT_EQ(flatDepth_mm(shape, std::nan(""), cos), 0.0);
      EXPECT_EQ(flatDepth_mm(shape, 1e9, cos), whole);
    }
}

TEST(FlatDepth, TakesTheSmearAway) {
  // The smeared volume by a plain sum over the Gaussian.
  constexpr double kSigma_mm = 0.04;
  for (const BurShape& shape : kShapes)
    for (const double angle : kAngles_deg) {
      const double cos = std::cos(calibration::radFromDegrees(angle));
      for (const double h : {0.01, 0.05, 0.1, 0.155, 0.165, 0.3}) {
        double smeared = 0.0, total = 0.0;
        for (double xi = -5.0; xi <= 5.0; xi += 0.02) {
          smeared += std::exp(-0.5 * xi * xi) * flatOverlap(shape, h + kSigma_mm * xi, cos).volume_mm3;
          total += std::exp(-0.5 * xi * xi);
        }
        EXPECT_NEAR(flatDepth_mm(shape, smeared / total, cos, kSigma_mm), h, 5e-4)
            << angle << "° " << static_cast<int>(shape.kind);
      }
    }
}

TEST(FlatDepth, AgreesWithTheSpheresClosedForm) {
  const BurShape sphere{ShapeKind::sphere, 2.0, 0.0};
  const double s = 0.1, sigma = std::sqrt(0.504 / kPi) * s;
  for (double volume = 1e-3; volume < 33.0; volume *= 1.3)
    EXPECT_NEAR(flatDepth_mm(sphere, volume, 0.3, sigma), equivalentDepth_mm(2.0, volume, s), 2e-5) << volume;
}

TEST(FlatDepth, RisesWithoutAJump) {
  // As the head goes in by a micrometre at a time, smeared as by voxels of 0.1 mm.
  for (const BurShape& shape : kShapes)
    for (const double cos : {-0.7, 0.0, 0.6, 0.999, 1.0}) {
      double last = 0.0;
      for (double h = 0.02; h < 0.3; h += 0.001) {
        const double depth = flatDepth_mm(shape, flatOverlap(shape, h, cos).volume_mm3, cos, 0.04);
        EXPECT_GE(depth, last - 1e-12) << h;
        if (last > 0.0) {
          EXPECT_LT(depth - last, 0.0035) << h << ' ' << cos << ' ' << static_cast<int>(shape.kind);
        }
        last = depth;
      }
    }
}

}  // namespace
}  // namespace haptics
