#include "app/evaluation/voice/chirp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace app {

std::vector<float> chirpAt(double rate_Hz) {
  constexpr double kFrom_Hz = 2000.0, kTo_Hz = 8000.0, kLoud = 0.5, kTurn = 2.0 * std::numbers::pi;
  std::vector<float> chirp(static_cast<std::size_t>(kChirp_s * rate_Hz));
  for (std::size_t n = 0; n < chirp.size(); ++n) {
    const double t_s = static_cast<double>(n) / rate_Hz;
    const double turns = kFrom_Hz * t_s + 0.5 * (kTo_Hz - kFrom_Hz) * t_s * t_s / kChirp_s;
    const double swell = std::sin(std::numbers::pi * t_s / kChirp_s);
    chirp[n] = static_cast<float>(kLoud * swell * std::sin(kTurn * turns));
  }
  return chirp;
}

std::optional<FoundChirp> findChirp(std::span<const float> sound, double rate_Hz) {
  constexpr double kLike = 0.4;
  const std::vector<float> chirp = chirpAt(rate_Hz);
  if (sound.size() < chirp.size()) return {};
  const double own = std::sqrt(std::inner_product(chirp.begin(), chirp.end(), chirp.begin(), 0.0));
  FoundChirp found;
  double power = 1e-9;
  for (std::size_t n = 0; n + 1 < chirp.size(); ++n) power += double{sound[n]} * sound[n];
  for (std::size_t at = 0; at + chirp.size() <= sound.size(); ++at) {
    const double newest = sound[at + chirp.size() - 1], oldest = sound[at];
    power += newest * newest;
    double product = 0.0;
    for (std::size_t n = 0; n < chirp.size(); ++n) product += double{chirp[n]} * sound[at + n];
    const double likeness = std::abs(product) / (own * std::sqrt(power));
    if (likeness > found.likeness) found = {at, likeness};
    power = std::max(1e-9, power - oldest * oldest);
  }
  return found.likeness < kLike ? std::nullopt : std::optional(found);
}

}  // namespace app
