// The cutting head of a bur: a solid of revolution in frame T, origin at its centre, +z along the shaft away from the
// tip, mm. Plain values and closed forms. Trivially copyable; any thread; under 50 ns a call, no allocation, no throw.
// Shaft: tool/tool; overlap with bone: contact/shape_overlap; mesh: assets/instrument.
#pragma once

#include <cstdint>

namespace haptics {

enum class ShapeKind : std::uint8_t { sphere, capsule, cylinder, cone };

struct BurShape {
  ShapeKind kind = ShapeKind::sphere;
  double radius_mm = 2.0;  ///< of the sphere, capsule, cylinder; of the cone's base, at its +z end
  double length_mm = 0.0;  ///< of the capsule's cylindrical part, the cylinder, the cone's height; 0 for a sphere

  bool operator==(const BurShape&) const = default;
};

/// Limits of the servo. Dental burs are well inside (ISO 2157: diameters 0.5..5 mm; heads up to 12 mm long).
inline constexpr double kMinBurRadius_mm = 0.1, kMaxBurRadius_mm = 6.0;
inline constexpr double kMinHeadLength_mm = 0.1, kMaxHeadLength_mm = 20.0;

/// The nearest shape in range, defaults for values that are not finite. A sphere's length is 0, a capsule's may be 0.
BurShape sanitised(const BurShape& shape) noexcept;

double volume_mm3(const BurShape& shape) noexcept;

/// Half the extent along z, from T's origin to either end.
double halfHeight_mm(const BurShape& shape) noexcept;

/// Support function: extent from T's origin in a direction whose cosine with +z is `cos_axis`.
double reach_mm(const BurShape& shape, double cos_axis) noexcept;

}  // namespace haptics
