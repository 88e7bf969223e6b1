// Smooth union and intersection of signed distances, negative inside: polynomial smooth minimum and maximum (Quilez
// 2013). `blend` is the width of the transition, in the unit of the distances; exact outside it, at most blend/4 too
// deep inside it. Any thread.
#pragma once

#include <algorithm>
#include <cmath>

namespace assets {

inline double smoothMin(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - 0.25 * h * h * blend;
}

inline double smoothMax(double a, double b, double blend) { return -smoothMin(-a, -b, blend); }

}  // namespace assets
