#include "haptics/contact/sliding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

/// Gauss-Legendre, five points on 0..1.
constexpr std::array<double, 5> kPlace = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                          0.953089922969332};
constexpr std::array<double, 5> kWeight = {0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                                           0.118463442528095};
constexpr int kAround = 16;

double armOfBall_mm(double radius_mm, double depth_mm, double sine) {
  const double depth = std::clamp(depth_mm, 0.0, radius_mm), cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  const double rim2 = depth * (2.0 * radius_mm - depth);
  double sum = 0.0;
  for (std::size_t ring = 0; ring < kPlace.size(); ++ring) {
    // With |x| = a sin(t) pressure times the ring's area is cos^2(t) sin(t) dt, of integral 1/3.
    const double t = 0.5 * calibration::kPi * kPlace[ring], away = std::sqrt(rim2) * std::sin(t);
    const double inwards = std::sqrt(radius_mm * radius_mm - away * away);
    double arms = 0.0;
    for (int n = 0; n < kAround; ++n) {
      const double along = inwards * cosine + away * sine * std::cos((n + 0.5) * 2.0 * calibration::kPi / kAround);
      arms += std::sqrt(std::max(0.0, radius_mm * radius_mm - along * along));
    }
    const double weight = 1.5 * calibration::kPi * kWeight[ring] * std::cos(t) * std::cos(t) * std::sin(t);
    sum += weight * arms / kAround;
  }
  return sum;
}

}  // namespace

double slidingArm_mm(const BurShape& head, double depth_mm, double sine) noexcept {
  const double R = head.radius_mm, s = std::clamp(sine, 0.0, 1.0);
  switch (head.kind) {
    case ShapeKind::sphere:
    case ShapeKind::capsule:
      return armOfBall_mm(R, depth_mm, s);
    case ShapeKind::cylinder:
      return R * (s * s + 2.0 / 3.0 * (1.0 - s * s));
    case ShapeKind::cone:
      return R * (0.5 * s * s + 2.0 / 3.0 * (1.0 - s * s));
    case ShapeKind::revolved: {
      // The side's mean radius over its height.
      const assets::BurOutline outline = revolvedOutline(head);
      double sum = 0.0;
      for (std::size_t n = 0; n + 1 < outline.count; ++n)
        sum += 0.5 * (outline.radius_mm[n] + outline.radius_mm[n + 1]) * (outline.z_mm[n + 1] - outline.z_mm[n]);
      return sum / head.length_mm * s * s + 2.0 / 3.0 * R * (1.0 - s * s);
    }
  }
  return 0.0;
}

}  // namespace haptics
