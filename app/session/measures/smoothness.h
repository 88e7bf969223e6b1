// How smooth a movement is, from its speed. Two measures of the literature and the share of tremor. No units but as
// said. Pure; any thread; a movement of n samples costs n times the frequencies below 10 Hz (0.4 ms for a second at
// 1 kHz).
//   dimensionless jerk DJ = T^3 / v_peak^2 * integral of (d2v/dt2)^2 dt, LDLJ = -ln DJ        minimum jerk: -5.32
//   SPARC: arc length of the spectrum of the speed, normalised in amplitude and frequency, up to 10 Hz or where it
//     falls below 0.05 for good; zero-padded four octaves                                    minimum jerk: -1.40
// Both are closer to 0 the smoother the movement is. Source: Balasubramanian et al. 2015, J NeuroEng Rehabil 12:112
// (reference/product R61, R62).
#pragma once

#include <optional>
#include <span>

namespace app {

/// -ln DJ of the speed at equal distances `dt_s`; none of fewer than four samples, or without movement.
std::optional<double> logDimensionlessJerk(std::span<const double> speed_mm_per_s, double dt_s);

/// None of fewer than four samples, or without movement.
std::optional<double> spectralArcLength(std::span<const double> speed_mm_per_s, double dt_s);

/// Power of the speed's changes from 8 to 12 Hz over that below 20 Hz, 0 to 1; none of less than 0.5 s, or of a speed
/// that does not change.
std::optional<double> tremorShare(std::span<const double> speed_mm_per_s, double dt_s);

}  // namespace app
