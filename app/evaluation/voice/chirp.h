// A chirp of 5 ms that is played at both ends of a recording, and found in it by cross-correlation: what the clock map
// cannot see is the constant delay between a sample and its arrival. 2 to 8 kHz, within the reach of small speakers.
// Pure; milliseconds a second of sound.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace app {

inline constexpr double kChirp_s = 0.005;

std::vector<float> chirpAt(double rate_Hz);

struct FoundChirp {
  std::size_t at = 0;     ///< its first sample
  double likeness = 0.0;  ///< 0 to 1: of its shape, whatever its loudness
};

/// The place that is most like it. None: nothing is.
std::optional<FoundChirp> findChirp(std::span<const float> sound, double rate_Hz);

}  // namespace app
