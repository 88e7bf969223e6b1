// Draws that are the same on every machine: std::mt19937 is, the standard library's distributions are not. Any thread,
// a generator per thread.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <random>

#include "calibration/geometry/units.h"

namespace calibration {

/// Evenly from `least` to `most`.
inline double evenly(std::mt19937& chance, double least, double most) {
  return least + (most - least) * (static_cast<double>(chance()) + 0.5) / 4294967296.0;
}

/// Normal, of this sigma (Box, Muller 1958).
inline double gaussian(std::mt19937& chance, double sigma) {
  const double radius = std::sqrt(-2.0 * std::log(evenly(chance, 0.0, 1.0)));
  return sigma * radius * std::cos(evenly(chance, 0.0, 2.0 * kPi));
}

inline glm::dvec3 gaussianVector(std::mt19937& chance, double sigma) {
  const double x = gaussian(chance, sigma), y = gaussian(chance, sigma);
  return {x, y, gaussian(chance, sigma)};
}

inline glm::dvec3 evenVector(std::mt19937& chance, const glm::dvec3& half) {
  const double x = evenly(chance, -half.x, half.x), y = evenly(chance, -half.y, half.y);
  return {x, y, evenly(chance, -half.z, half.z)};
}

}  // namespace calibration
