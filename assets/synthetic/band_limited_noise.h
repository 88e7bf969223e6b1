// Stationary random field with wavelengths in a band: a sum of plane waves with seeded directions and phases (Shinozuka
// and Deodatis 1991). Zero mean, unit variance, nearly Gaussian, isotropic. mm in, no unit out. Immutable; any thread;
// one cosine per wave and call. Deterministic from the seed.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "calibration/random.h"

namespace assets {

/// A well-mixed 64-bit hash.
constexpr std::uint64_t mixBits(std::uint64_t x) { return calibration::mixedBits(x + calibration::kSplitMixStep); }

class BandLimitedNoise {
 public:
  BandLimitedNoise(std::uint64_t seed, double shortest_mm, double longest_mm, int waves);

  double at(const glm::dvec3& point_mm) const;

 private:
  struct Wave {
    glm::dvec3 wave_number_per_mm;
    double phase_rad;
  };
  std::vector<Wave> waves_;
  double amplitude_;
};

}  // namespace assets
