// Textbook formulae of a plane-parallel glass plate, to check the traced rays against. mm, rad; angles to the normal.
#pragma once

#include <cmath>

#include "calibration/synthetic/glass_plate.h"

namespace calibration {

/// t sin(a) (1 - cos(a) / sqrt(n^2 - sin^2 a)): lateral shift of a ray behind the plate.
inline double plateShift_mm(const GlassPlate& plate, double angle_rad) {
  const double sine = std::sin(angle_rad), cosine = std::cos(angle_rad), n = plate.refractive_index;
  return plate.thickness_mm * sine * (1.0 - cosine / std::sqrt(n * n - sine * sine));
}

/// Distance, across the ray, between the images that front and far face reflect.
inline double ghostSpacing_mm(const GlassPlate& plate, double angle_rad) {
  const double sine = std::sin(angle_rad), n = plate.refractive_index;
  return 2.0 * plate.thickness_mm * sine / std::sqrt(n * n - sine * sine) * std::cos(angle_rad);
}

}  // namespace calibration
