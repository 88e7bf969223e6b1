#include "haptics/contact/cap.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/bone/voxel_sphere.h"

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

/// Volume of a cap smeared by a Gaussian `sigma` in depth, and its change with depth.
struct SmearedCap {
  double volume, slope;
};
SmearedCap smearedCap(double radius, double h, double sigma) {
  const double z = h / sigma, s2 = sigma * sigma;
  const double below = 0.5 * std::erfc(-z / std::sqrt(2.0)), density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * kPi);
  const double x1 = h * below + sigma * density;
  const double x2 = (h * h + s2) * below + h * sigma * density;
  const double x3 = (h * h + 3.0 * s2) * h * below + (h * h + 2.0 * s2) * sigma * density;
  return {kPi * (radius * x2 - x3 / 3.0), kPi * (2.0 * radius * x1 - x2)};
}

/// Depth of at most half a ball from a volume smeared by `sigma` in depth.
double smearedDepth(double radius, double volume, double sigma) {
  if (volume <= smearedCap(radius, 0.0, sigma).volume) return 0.0;
  double h = radius * shallowHeight(volume / (4.0 / 3.0 * kPi * radius * radius * radius));
  for (int i = 0; i < 8; ++i) {
    const SmearedCap cap = smearedCap(radius, h, sigma);
    const double step = (cap.volume - volume) / cap.slope;
    h -= step;
    if (std::abs(step) < 1e-12 * radius) break;
  }
  return std::clamp(h, 0.0, radius);
}

/// Of a face one voxel soft, in voxels (reference/physics 0.6).
const double kUsualSigma = std::sqrt(0.504 / kPi);

/// Depth of any part of a ball; `sigma_at` gives the smear for a volume of at most half of it.
template <class Sigma>
double depthOf(double radius_mm, double volume_mm3, Sigma sigma_at) {
  const double ball = 4.0 / 3.0 * kPi * radius_mm * radius_mm * radius_mm;
  if (!(volume_mm3 > 0.0)) return 0.0;
  if (volume_mm3 >= ball) return 2.0 * radius_mm;
  // The face beyond the centre is the same sum seen from the other side.
  const bool beyond = volume_mm3 > 0.5 * ball;
  const double volume = beyond ? ball - volume_mm3 : volume_mm3;
  const double h = smearedDepth(radius_mm, volume, sigma_at(volume));
  return beyond ? 2.0 * radius_mm - h : h;
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

double faceSmear_mm(double grey_per_area_mm, double layers, double spacing_mm) {
  const double found = std::clamp(grey_per_area_mm, 0.0, 0.25 * spacing_mm);
  // The softness is not known in a touch of less than a layer.
  const double known = std::clamp(layers - 0.5, 0.0, 1.0);
  const double softness = known * found + (1.0 - known) * spacing_mm / 6.0;
  const double eta = kVoxelSphereRadius * spacing_mm;
  const double variance = eta * eta / 5.0 - spacing_mm * spacing_mm / 12.0 + spacing_mm * softness;
  return std::sqrt(std::max(variance, 1e-4 * spacing_mm * spacing_mm));
}

double equivalentDepth_mm(double radius_mm, double volume_mm3, double spacing_mm) {
  return depthOf(radius_mm, volume_mm3, [&](double) { return kUsualSigma * spacing_mm; });
}

double equivalentDepth_mm(double radius_mm, double volume_mm3, double grey_mm3, double spacing_mm) {
  return depthOf(radius_mm, volume_mm3, [&](double volume) {
    // The face's area, from its depth if it were one voxel soft.
    const double usual = kUsualSigma * spacing_mm;
    const double h = smearedDepth(radius_mm, volume, usual), area = smearedCap(radius_mm, h, usual).slope;
    return faceSmear_mm(grey_mm3 / area, h / spacing_mm, spacing_mm);
  });
}

}  // namespace haptics
