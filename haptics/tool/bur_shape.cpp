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

}  // namespace

BurShape sanitised(const BurShape& shape) noexcept {
  const BurShape defaults;
  BurShape safe;
  safe.kind = shape.kind <= ShapeKind::cone ? shape.kind : defaults.kind;
  safe.radius_mm = within(shape.radius_mm, kMinBurRadius_mm, kMaxBurRadius_mm, defaults.radius_mm);
  const double min = safe.kind == ShapeKind::capsule ? 0.0 : kMinHeadLength_mm;
  safe.length_mm = safe.kind == ShapeKind::sphere ? 0.0 : within(shape.length_mm, min, kMaxHeadLength_mm, min);
  return safe;
}

double volume_mm3(const BurShape& shape) noexcept {
  const double disc = kPi * shape.radius_mm * shape.radius_mm, ball = 4.0 / 3.0 * disc * shape.radius_mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return ball;
    case ShapeKind::capsule:
      return ball + disc * shape.length_mm;
    case ShapeKind::cylinder:
      return disc * shape.length_mm;
    case ShapeKind::cone:
      return disc * shape.length_mm / 3.0;
  }
  return 0.0;
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
  }
  return 0.0;
}

}  // namespace haptics
