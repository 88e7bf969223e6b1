// The cutting head of a bur: a body of revolution in frame T, origin at its centre, +z along the shaft away from the
// tip, mm. Trivially copyable; any thread. Not the shaft (tool/tool) and not the picture (assets/instrument).
#pragma once

#include <cstdint>

namespace haptics {

enum class ShapeKind : std::uint8_t { sphere, capsule, cylinder, cone };

struct BurShape {
  ShapeKind kind = ShapeKind::sphere;
  double radius_mm = 2.0;  ///< of the sphere, capsule, cylinder; of the cone's base, at its +z end
  double length_mm = 0.0;  ///< of the capsule's cylindrical part, the cylinder, the cone's height; 0 for a sphere
};

}  // namespace haptics
