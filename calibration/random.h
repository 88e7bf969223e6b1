// Random numbers that are the same on every machine, which the standard distributions are not: uniform and normal draws
// from std::mt19937, and SplitMix64 (Steele, Lea, Flood, OOPSLA 2014) as a hash and a small generator. Do not exchange
// one for the other: recorded results depend on them. Any thread, one generator per thread. Not for secrets.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "calibration/geometry/units.h"

namespace calibration {

/// Uniform from `least` to `most`.
inline double uniform(std::mt19937& rng, double least, double most) {
  return least + (most - least) * (static_cast<double>(rng()) + 0.5) / 4294967296.0;
}

/// Normal with this sigma (Box, Muller 1958).
inline double gaussian(std::mt19937& rng, double sigma) {
  const double radius = std::sqrt(-2.0 * std::log(uniform(rng, 0.0, 1.0)));
  return sigma * radius * std::cos(uniform(rng, 0.0, 2.0 * kPi));
}

inline glm::dvec3 gaussianVector(std::mt19937& rng, double sigma) {
  const double x = gaussian(rng, sigma), y = gaussian(rng, sigma);
  return {x, y, gaussian(rng, sigma)};
}

inline glm::dvec3 uniformVector(std::mt19937& rng, const glm::dvec3& half) {
  const double x = uniform(rng, -half.x, half.x), y = uniform(rng, -half.y, half.y);
  return {x, y, uniform(rng, -half.z, half.z)};
}

/// Increment of SplitMix64's sequence.
inline constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15ull;

/// SplitMix64's finaliser: a bijection that mixes all bits.
constexpr std::uint64_t mixedBits(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

class RandomGenerator {
 public:
  /// `stream` separates the uses of one seed.
  explicit RandomGenerator(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mixedBits(seed) ^ mixedBits(~stream)) {}

  std::uint64_t bits() { return mixedBits(state_ += kSplitMixStep); }
  /// 0 <= u < 1.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  bool coin(double probability) { return uniform() < probability; }
  /// 0..n-1, n >= 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * kPi * uniform());
  }

  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace calibration
