#include "app/session/measures/smoothness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace app {
namespace {

/// The spectrum at one frequency, in cycles a sample, by a rotating phasor.
std::complex<double> spectrumAt(std::span<const double> values, double cycles) {
  const std::complex<double> turn = std::polar(1.0, -2.0 * std::numbers::pi * cycles);
  std::complex<double> sum = 0.0, phasor = 1.0;
  for (const double value : values) sum += value * phasor, phasor *= turn;
  return sum;
}

}  // namespace

std::optional<double> logDimensionlessJerk(std::span<const double> speed_mm_per_s, double dt_s) {
  const std::size_t n = speed_mm_per_s.size();
  if (n < 4 || !(dt_s > 0.0)) return {};
  const double peak = *std::ranges::max_element(speed_mm_per_s);
  if (!(peak > 0.0)) return {};
  double integral = 0.0;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double bend = (speed_mm_per_s[k + 1] - 2.0 * speed_mm_per_s[k] + speed_mm_per_s[k - 1]) / (dt_s * dt_s);
    integral += bend * bend * dt_s;
  }
  const double duration_s = dt_s * static_cast<double>(n - 1);
  if (!(integral > 0.0)) return {};
  return -std::log(duration_s * duration_s * duration_s / (peak * peak) * integral);
}

std::optional<double> spectralArcLength(std::span<const double> speed_mm_per_s, double dt_s) {
  constexpr double kCutOff_Hz = 10.0, kThreshold = 0.05;
  constexpr int kOctaves = 4;
  const std::size_t n = speed_mm_per_s.size();
  if (n < 4 || !(dt_s > 0.0)) return {};
  const double padded = static_cast<double>(std::bit_ceil(n) << kOctaves);
  const double step_Hz = 1.0 / (padded * dt_s);
  std::vector<double> magnitude;
  for (double f_Hz = 0.0; f_Hz <= kCutOff_Hz && f_Hz <= 0.5 / dt_s; f_Hz += step_Hz)
    magnitude.push_back(std::abs(spectrumAt(speed_mm_per_s, f_Hz * dt_s)));
  const double most = *std::ranges::max_element(magnitude);
  if (!(most > 0.0)) return {};
  for (double& value : magnitude) value /= most;

  // From the first frequency to the last at or above the threshold.
  const auto above = [](double value) { return value >= kThreshold; };
  const auto first = std::ranges::find_if(magnitude, above);
  const auto last = std::find_if(magnitude.rbegin(), magnitude.rend(), above).base() - 1;
  const double steps = static_cast<double>(last - first);
  if (steps < 1.0) return {};
  double length = 0.0;
  for (auto at = first; at != last; ++at) length += std::hypot(1.0 / steps, at[1] - at[0]);
  return -length;
}

std::optional<double> tremorShare(std::span<const double> speed_mm_per_s, double dt_s) {
  constexpr double kShortest_s = 0.5, kFrom_Hz = 8.0, kTo_Hz = 12.0, kAll_Hz = 20.0;
  const std::size_t n = speed_mm_per_s.size();
  const double duration_s = dt_s * static_cast<double>(n);
  if (!(duration_s >= kShortest_s)) return {};
  double mean = 0.0;
  for (const double value : speed_mm_per_s) mean += value / static_cast<double>(n);
  // Without the mean, in a Hann window, so that its ends are no frequency.
  std::vector<double> changes(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double u = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    changes[k] = (speed_mm_per_s[k] - mean) * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * u));
  }
  double tremor = 0.0, all = 0.0;
  const double step_Hz = 1.0 / duration_s;
  for (double f_Hz = step_Hz; f_Hz <= kAll_Hz; f_Hz += step_Hz) {
    const double power = std::norm(spectrumAt(changes, f_Hz * dt_s));
    all += power;
    if (f_Hz >= kFrom_Hz && f_Hz <= kTo_Hz) tremor += power;
  }
  if (!(all > 1e-12 * static_cast<double>(n))) return {};
  return tremor / all;
}

}  // namespace app
