#include "app/device/check/force_scale_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace app {

ForceScaleFit forceScale(std::span<const ForceReading> readings) {
  const double n = static_cast<double>(readings.size());
  double mean_asked_N = 0.0, mean_shown_N = 0.0;
  for (const ForceReading& one : readings) {
    mean_asked_N += one.asked_N / n;
    mean_shown_N += one.shown_N / n;
  }
  double spread = 0.0, together = 0.0;
  for (const ForceReading& one : readings) {
    spread += (one.asked_N - mean_asked_N) * (one.asked_N - mean_asked_N);
    together += (one.asked_N - mean_asked_N) * (one.shown_N - mean_shown_N);
  }
  assert(readings.size() >= 2 && spread > 0.0);

  ForceScaleFit fit;
  fit.scale = together / spread;
  fit.offset_N = mean_shown_N - fit.scale * mean_asked_N;
  double squares = 0.0;
  for (const ForceReading& one : readings) {
    const double off_N = one.shown_N - fit.scale * one.asked_N - fit.offset_N;
    squares += off_N * off_N;
    fit.worst_N = std::max(fit.worst_N, std::abs(off_N));
  }
  if (readings.size() > 2) fit.scale_error = std::sqrt(squares / (n - 2.0) / spread);
  return fit;
}

}  // namespace app
