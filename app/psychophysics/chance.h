// Chance that is the same everywhere: a seeded generator and the few distributions an experiment needs, spelled out
// because the standard library's differ between implementations. Bits by calibration/geometry/mixed_bits; Box-Muller
// for the normal. One thread per object. Not for secrets.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "calibration/geometry/mixed_bits.h"

namespace app {

class Chance {
 public:
  /// `stream` separates the uses of one seed: hand, order, observer.
  explicit Chance(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(calibration::mixedBits(seed) ^ calibration::mixedBits(~stream)) {}

  std::uint64_t bits() { return calibration::mixedBits(state_ += calibration::kMixedStep); }
  /// 0 <= u < 1.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  bool coin(double probability) { return uniform() < probability; }
  /// 0..n-1, n >= 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace app
