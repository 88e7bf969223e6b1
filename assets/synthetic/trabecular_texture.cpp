#include "assets/synthetic/trabecular_texture.h"

#include <algorithm>
#include <cmath>

#include "assets/synthetic/implicit_shape.h"

namespace assets {
namespace {

constexpr double kMarrow_hu = 10.0;
constexpr double kStrut_hu = 1150.0;
// Rms gradient in one direction of a unit field with wavelengths 1.7-3 mm, times 1.5.
constexpr double kFieldSlope_per_mm = 2.6;

}  // namespace

TrabecularTexture::TrabecularTexture(std::uint64_t seed, double blur_mm)
    : plate_(seed, 1.7, 2.9, 28),
      rod_(seed + 1, 1.7, 2.9, 28),
      density_(seed + 2, 7.0, 14.0, 12),
      softness_(kFieldSlope_per_mm * blur_mm) {}

double TrabecularTexture::hounsfield(const glm::dvec3& p_J) const {
  // Regions of different density; the second field makes rods of plates.
  const double density = density_.at(p_J);
  const double plate = plate_.at(p_J), rod = rod_.at(p_J);
  const double half_width = 0.64 + 0.11 * density;
  const double axis_distance = std::sqrt(plate * plate + 0.22 * rod * rod);
  const double bone = 0.5 * std::erfc((axis_distance - half_width) / (std::sqrt(2.0) * softness_));
  return kMarrow_hu + (kStrut_hu - kMarrow_hu) * bone;
}

}  // namespace assets
