// The colours of how far a preparation lies from its ideal, in pictures and on the live tooth alike: blue too deep,
// pale as planned, red too high (hues of Okabe and Ito, "Color universal design", 2008). sRGB, 0..1. Pure; any thread.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace app {

/// From here on the colour stays.
inline constexpr double kFullColour_mm = 0.5;

inline glm::dvec3 deviationColour(double deviation_mm) {
  constexpr glm::dvec3 kBlue(0.0, 0.447, 0.698), kPale(0.93, 0.90, 0.84), kRed(0.835, 0.369, 0.0);
  const double share = std::clamp(std::abs(deviation_mm) / kFullColour_mm, 0.0, 1.0);
  return glm::mix(kPale, deviation_mm > 0.0 ? kRed : kBlue, share);
}

}  // namespace app
