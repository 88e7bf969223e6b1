// The cutting head of a bur: a body of revolution in frame T, origin at its centre, +z along the shaft away from the
// tip, mm. Plain values and closed forms: volume, reach. Trivially copyable; any thread; under 50 ns a call, no
// allocation, no throw. Not the shaft (tool/tool), not what it shares with bone (contact/shape_overlap), not the
// picture (assets/instrument).
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

/// What the servo takes. Dental burs lie well inside (ISO 2157: diameters 0.5..5 mm; heads up to 12 mm long).
inline constexpr double kMinBurRadius_mm = 0.1, kMaxBurRadius_mm = 6.0;
inline constexpr double kMinHeadLength_mm = 0.1, kMaxHeadLength_mm = 20.0;

/// The nearest shape in range; a number that is none becomes the default's. A sphere's length is 0, a capsule's may be.
BurShape sanitised(const BurShape& shape) noexcept;

double volume_mm3(const BurShape& shape) noexcept;

/// Half the height along z: every head reaches from -this to +this.
double halfHeight_mm(const BurShape& shape) noexcept;

/// How far the head reaches from T's origin in a direction whose cosine with +z is `cos_axis` (support function).
double reach_mm(const BurShape& shape, double cos_axis) noexcept;

}  // namespace haptics
