// Stationary random field whose wavelengths lie in a band: a sum of plane waves with seeded directions and phases.
// Zero mean, unit variance, nearly Gaussian; isotropic, no lattice to be seen in it. mm in, no unit out.
// Immutable; any thread; one cosine per wave and call. Deterministic from the seed. Not the scanner's noise
// (scanner.h). Method: spectral synthesis of a Gaussian field (Shinozuka and Deodatis, 1991).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

/// A well-mixed 64-bit hash (splitmix64 finaliser, Steele et al. 2014).
constexpr std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

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
