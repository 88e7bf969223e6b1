// Smooth set operations and profiles on signed distances (negative inside), the alphabet of the synthetic anatomy.
// mm in, mm out; `blend_mm` is the width over which two surfaces flow into each other. Any thread; a few flops each.
// Polynomial smooth minimum after Quilez (2013): exact outside the blend, at most blend/4 too deep inside it.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace assets {

inline double smoothMin(double a_mm, double b_mm, double blend_mm) {
  const double h = std::max(blend_mm - std::abs(a_mm - b_mm), 0.0) / blend_mm;
  return std::min(a_mm, b_mm) - 0.25 * h * h * blend_mm;
}

inline double smoothMax(double a_mm, double b_mm, double blend_mm) { return -smoothMin(-a_mm, -b_mm, blend_mm); }

/// 0 below `from`, 1 above `to`, C1 between; `from` may exceed `to`.
inline double smoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

struct ProfileKnot {
  double at = 0.0;
  double value = 0.0;
};

/// Cubic Hermite interpolation through knots in rising order, slopes by finite differences, constant beyond the ends.
inline double profile(std::span<const ProfileKnot> knots, double at) {
  if (at <= knots.front().at) return knots.front().value;
  if (at >= knots.back().at) return knots.back().value;
  std::size_t i = 0;
  while (at > knots[i + 1].at) ++i;
  const auto slope = [&](std::size_t k) {
    if (k == 0 || k + 1 == knots.size()) return 0.0;
    return (knots[k + 1].value - knots[k - 1].value) / (knots[k + 1].at - knots[k - 1].at);
  };
  const double width = knots[i + 1].at - knots[i].at;
  const double t = (at - knots[i].at) / width;
  const double u = 1.0 - t;
  return u * u * ((1.0 + 2.0 * t) * knots[i].value + t * width * slope(i)) +
         t * t * ((3.0 - 2.0 * t) * knots[i + 1].value - u * width * slope(i + 1));
}

}  // namespace assets
