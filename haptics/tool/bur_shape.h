// The cutting head of a bur: a solid of revolution in frame T, origin at its centre, +z along the shaft away from the
// tip, mm. Plain values and closed forms. Trivially copyable; any thread; under 50 ns a call, no allocation, no throw.
// Shaft: tool/tool; overlap with bone: contact/shape_overlap; mesh: assets/instrument.
#pragma once

#include <cstdint>

#include "assets/bur_outline.h"

namespace haptics {

enum class ShapeKind : std::uint8_t { sphere, capsule, cylinder, cone, revolved };
inline constexpr int kShapeKinds = 5;

struct BurShape {
  ShapeKind kind = ShapeKind::sphere;
  double radius_mm = 2.0;  ///< of the sphere, capsule, cylinder; of the cone's base, at its +z end; the largest
  double length_mm = 0.0;  ///< of the capsule's cylindrical part, the cylinder, the cone's height; 0 for a sphere
  assets::BurProfile profile = assets::BurProfile::wheel;  ///< of a revolved head; otherwise wheel

  bool operator==(const BurShape&) const = default;
};

/// Limits of the servo. Dental burs are well inside (ISO 2157: diameters 0.5..5 mm; heads up to 12 mm long).
inline constexpr double kMinBurRadius_mm = 0.1, kMaxBurRadius_mm = 6.0;
inline constexpr double kMinHeadLength_mm = 0.1, kMaxHeadLength_mm = 20.0;

/// The nearest shape in range, defaults for values that are not finite. A sphere's length is 0, a capsule's may be 0.
BurShape sanitised(const BurShape& shape) noexcept;

/// Flat ends: a capsule, a sphere and some revolved heads have round ones.
bool hasFlatEnd(const BurShape& shape) noexcept;

/// Of a revolved head.
inline assets::BurOutline revolvedOutline(const BurShape& shape) noexcept {
  return assets::burOutline(shape.profile, shape.radius_mm, shape.length_mm);
}

double volume_mm3(const BurShape& shape) noexcept;

/// Of the whole head, over pi.
double surfacePerPi_mm2(const BurShape& shape) noexcept;

/// The centre of the volume, from T's origin along +z.
double centroid_mm(const BurShape& shape) noexcept;

/// Radius of about the largest ball inside the head.
double largestBall_mm(const BurShape& shape) noexcept;

/// Half the extent along z, from T's origin to either end.
double halfHeight_mm(const BurShape& shape) noexcept;

/// Support function: extent from T's origin in a direction whose cosine with +z is `cos_axis`.
double reach_mm(const BurShape& shape, double cos_axis) noexcept;

}  // namespace haptics
