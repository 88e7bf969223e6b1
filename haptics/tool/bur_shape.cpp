#include "haptics/tool/bur_shape.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::kPi;

double within(double value, double min, double max, double fallback) {
  return std::isfinite(value) ? std::clamp(value, min, max) : fallback;
}

/// Calls visit(r0, z0, r1, z1) for every frustum of a revolved head.
template <class Visit>
void visitFrustums(const BurShape& shape, Visit&& visit) {
  const assets::BurOutline outline = revolvedOutline(shape);
  for (std::size_t n = 0; n + 1 < outline.count; ++n)
    visit(outline.radius_mm[n], outline.z_mm[n], outline.radius_mm[n + 1], outline.z_mm[n + 1]);
}

}  // namespace

BurShape sanitised(const BurShape& shape) noexcept {
  const BurShape defaults;
  BurShape safe;
  safe.kind = shape.kind <= ShapeKind::revolved ? shape.kind : defaults.kind;
  safe.radius_mm = within(shape.radius_mm, kMinBurRadius_mm, kMaxBurRadius_mm, defaults.radius_mm);
  double min = safe.kind == ShapeKind::capsule ? 0.0 : kMinHeadLength_mm;
  if (safe.kind == ShapeKind::revolved) {
    if (static_cast<std::size_t>(shape.profile) < assets::kBurProfiles) safe.profile = shape.profile;
    min = std::max(min, assets::leastBurLength_mm(safe.profile, safe.radius_mm));
  }
  safe.length_mm = safe.kind == ShapeKind::sphere ? 0.0 : within(shape.length_mm, min, kMaxHeadLength_mm, min);
  return safe;
}

bool hasFlatEnd(const BurShape& shape) noexcept {
  if (shape.kind != ShapeKind::revolved) return shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone;
  const assets::BurOutline outline = revolvedOutline(shape);
  return outline.radius_mm[0] > 0.0 || outline.radius_mm[outline.count - 1] > 0.0;
}

double volume_mm3(const BurShape& shape) noexcept {
  const double disc = kPi * shape.radius_mm * shape.radius_mm, ball = 4.0 / 3.0 * disc * shape.radius_mm;
  double sum = 0.0;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return ball;
    case ShapeKind::capsule:
      return ball + disc * shape.length_mm;
    case ShapeKind::cylinder:
      return disc * shape.length_mm;
    case ShapeKind::cone:
      return disc * shape.length_mm / 3.0;
    case ShapeKind::revolved:
      visitFrustums(shape, [&](double r0, double z0, double r1, double z1) {
        sum += kPi / 3.0 * (z1 - z0) * (r0 * r0 + r0 * r1 + r1 * r1);
      });
      return sum;
  }
  return 0.0;
}

double surfacePerPi_mm2(const BurShape& shape) noexcept {
  const double R = shape.radius_mm, L = shape.length_mm;
  double sum = 0.0;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return 4.0 * R * R;
    case ShapeKind::capsule:
      return 4.0 * R * R + 2.0 * R * L;
    case ShapeKind::cylinder:
      return 2.0 * R * R + 2.0 * R * L;
    case ShapeKind::cone:
      return R * R + R * std::hypot(R, L);
    case ShapeKind::revolved: {
      const assets::BurOutline outline = revolvedOutline(shape);
      const double low = outline.radius_mm[0], high = outline.radius_mm[outline.count - 1];
      sum = low * low + high * high;
      visitFrustums(
          shape, [&](double r0, double z0, double r1, double z1) { sum += (r0 + r1) * std::hypot(r1 - r0, z1 - z0); });
      return sum;
    }
  }
  return 0.0;
}

double centroid_mm(const BurShape& shape) noexcept {
  if (shape.kind == ShapeKind::cone) return 0.25 * shape.length_mm;
  if (shape.kind != ShapeKind::revolved) return 0.0;
  double moment = 0.0;
  visitFrustums(shape, [&](double r0, double z0, double r1, double z1) {
    const double rm = 0.5 * (r0 + r1), zm = 0.5 * (z0 + z1);
    moment += kPi * (z1 - z0) / 6.0 * (r0 * r0 * z0 + 4.0 * rm * rm * zm + r1 * r1 * z1);
  });
  return moment / volume_mm3(shape);
}

double largestBall_mm(const BurShape& shape) noexcept {
  const double R = shape.radius_mm, L = shape.length_mm;
  if (shape.kind == ShapeKind::cone) return R * L / (R + std::hypot(R, L));
  if (shape.kind == ShapeKind::cylinder) return std::min(R, 0.5 * L);
  if (shape.kind != ShapeKind::revolved) return R;
  const assets::BurOutline outline = revolvedOutline(shape);
  double largest = 0.0;
  constexpr int kHeights = 15;
  for (int n = 1; n <= kHeights; ++n)
    largest = std::max(largest,
                       -assets::outlineDistance_mm(outline, 0.0, L * (static_cast<double>(n) / (kHeights + 1) - 0.5)));
  return largest;
}

double halfHeight_mm(const BurShape& shape) noexcept {
  if (shape.kind == ShapeKind::sphere) return shape.radius_mm;
  return 0.5 * shape.length_mm + (shape.kind == ShapeKind::capsule ? shape.radius_mm : 0.0);
}

double reach_mm(const BurShape& shape, double cos_axis) noexcept {
  const double c = std::clamp(cos_axis, -1.0, 1.0), s = std::sqrt(1.0 - c * c), half = 0.5 * shape.length_mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return shape.radius_mm;
    case ShapeKind::capsule:
      return shape.radius_mm + std::abs(c) * half;
    case ShapeKind::cylinder:
      return s * shape.radius_mm + std::abs(c) * half;
    case ShapeKind::cone:
      return std::max(s * shape.radius_mm + c * half, -c * half);
    case ShapeKind::revolved: {
      const assets::BurOutline outline = revolvedOutline(shape);
      double reach = -half;
      for (std::size_t n = 0; n < outline.count; ++n)
        reach = std::max(reach, s * outline.radius_mm[n] + c * outline.z_mm[n]);
      return reach;
    }
  }
  return 0.0;
}

}  // namespace haptics
