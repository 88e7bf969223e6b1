#include "app/report/axis_ticks.h"

#include <algorithm>
#include <cmath>

#include "app/text/printed.h"

namespace app {

AxisTicks axisTicks(double low, double high, int wanted, bool whole) {
  if (!(std::isfinite(low) && std::isfinite(high)) || !(high > low)) low = 0.0, high = 1.0;
  AxisTicks ticks;
  const double raw = (high - low) / std::max(1, wanted);
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  ticks.step = 10.0 * decade;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * decade >= raw * (1.0 - 1e-9)) ticks.step = factor * decade;
  const double slack = 1e-9 * ticks.step;
  const double first = whole ? std::floor((low + slack) / ticks.step) : std::ceil((low - slack) / ticks.step);
  const double last = whole ? std::ceil((high - slack) / ticks.step) : std::floor((high + slack) / ticks.step);
  ticks.low = whole ? first * ticks.step : low;
  ticks.high = whole ? last * ticks.step : high;
  for (double n = first; n <= last; n += 1.0) ticks.at.push_back(n == 0.0 ? 0.0 : n * ticks.step);
  return ticks;
}

std::string AxisTicks::text(double value) const {
  const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  const std::string text = printed("%.*f", digits, value);
  // A true minus, as in print.
  return text[0] == '-' ? "\u2212" + text.substr(1) : text;
}

}  // namespace app
