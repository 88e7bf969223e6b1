#include "haptics/contact/cap.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::kPi;

/// Depth in radii of the cap that is the fraction u of its ball, for u <= 1/2.
double shallowHeight(double u) {
  double t =
      u < 1e-4 ? std::sqrt(4.0 / 3.0 * u) : 1.0 + 2.0 * std::cos(std::acos(1.0 - 2.0 * u) / 3.0 - 2.0 * kPi / 3.0);
  for (int i = 0; i < 3 && t > 0.0; ++i) {
    const double f = t * t * (3.0 - t) / 4.0 - u, slope = (6.0 - 3.0 * t) * t / 4.0, bend = (6.0 - 6.0 * t) / 4.0;
    t -= 2.0 * f * slope / (2.0 * slope * slope - f * bend);
  }
  return t;
}

/// Depth of at most half a ball from a volume smeared by `sigma` in depth.
double smearedDepth(double radius, double volume, double sigma) {
  const auto smeared = [&](double h, double& slope) {
    const double z = h / sigma;
    const double below = 0.5 * std::erfc(-z / std::sqrt(2.0)), density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * kPi);
    const double s2 = sigma * sigma;
    const double x1 = h * below + sigma * density;
    const double x2 = (h * h + s2) * below + h * sigma * density;
    const double x3 = (h * h + 3.0 * s2) * h * below + (h * h + 2.0 * s2) * sigma * density;
    slope = kPi * (2.0 * radius * x1 - x2);
    return kPi * (radius * x2 - x3 / 3.0);
  };
  double slope = 0.0;
  if (volume <= smeared(0.0, slope)) return 0.0;
  double h = radius * shallowHeight(volume / (4.0 / 3.0 * kPi * radius * radius * radius));
  for (int i = 0; i < 8; ++i) {
    const double step = (smeared(h, slope) - volume) / slope;
    h -= step;
    if (std::abs(step) < 1e-12 * radius) break;
  }
  return std::clamp(h, 0.0, radius);
}

}  // namespace

double capVolume_mm3(double radius_mm, double depth_mm) {
  const double h = std::clamp(depth_mm, 0.0, 2.0 * radius_mm);
  return kPi * h * h * (radius_mm - h / 3.0);
}

double capMoment_mm4(double radius_mm, double depth_mm) {
  const double h = std::clamp(depth_mm, 0.0, 2.0 * radius_mm);
  const double rim2 = h * (2.0 * radius_mm - h);
  return 0.25 * kPi * rim2 * rim2;
}

double capHeight_mm(double radius_mm, double volume_mm3) {
  const double u = volume_mm3 / (4.0 / 3.0 * kPi * radius_mm * radius_mm * radius_mm);
  if (!(u > 0.0)) return 0.0;
  if (u >= 1.0) return 2.0 * radius_mm;
  return radius_mm * (u <= 0.5 ? shallowHeight(u) : 2.0 - shallowHeight(1.0 - u));
}

double equivalentDepth_mm(double radius_mm, double volume_mm3, double spacing_mm) {
  const double ball = 4.0 / 3.0 * kPi * radius_mm * radius_mm * radius_mm;
  const double sigma = std::sqrt(0.504 / kPi) * spacing_mm;
  if (!(volume_mm3 > 0.0)) return 0.0;
  if (volume_mm3 >= ball) return 2.0 * radius_mm;
  // The face beyond the centre is the same sum seen from the other side.
  if (volume_mm3 <= 0.5 * ball) return smearedDepth(radius_mm, volume_mm3, sigma);
  return 2.0 * radius_mm - smearedDepth(radius_mm, ball - volume_mm3, sigma);
}

}  // namespace haptics
