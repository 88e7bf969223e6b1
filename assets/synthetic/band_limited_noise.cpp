#include "assets/synthetic/band_limited_noise.h"

#include <cmath>

#include "calibration/geometry/units.h"

namespace assets {

BandLimitedNoise::BandLimitedNoise(std::uint64_t seed, double shortest_mm, double longest_mm, int waves)
    : amplitude_(std::sqrt(2.0 / waves)) {
  std::uint64_t state = mixBits(seed);
  const auto uniform = [&state] {
    state = mixBits(state);
    return static_cast<double>(state >> 11) * 0x1.0p-53;
  };
  for (int w = 0; w < waves; ++w) {
    const double height = 2.0 * uniform() - 1.0;
    const double longitude_rad = 2.0 * calibration::kPi * uniform();
    const double wavelength_mm = shortest_mm + (longest_mm - shortest_mm) * uniform();
    const double ring = std::sqrt(1.0 - height * height);
    const glm::dvec3 direction(ring * std::cos(longitude_rad), ring * std::sin(longitude_rad), height);
    waves_.push_back({2.0 * calibration::kPi / wavelength_mm * direction, 2.0 * calibration::kPi * uniform()});
  }
}

double BandLimitedNoise::at(const glm::dvec3& point_mm) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(glm::dot(wave.wave_number_per_mm, point_mm) + wave.phase_rad);
  return amplitude_ * sum;
}

}  // namespace assets
