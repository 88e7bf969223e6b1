// Where an axis is marked: steps of 1, 2 or 5 times a power of ten, about `wanted` of them, and the numbers written
// with just the digits the step needs. Pure.
#pragma once

#include <string>
#include <vector>

namespace app {

struct AxisTicks {
  double low = 0.0, high = 1.0;  ///< the range, widened to whole steps where it was asked
  double step = 0.2;
  std::vector<double> at;

  std::string text(double value) const;
};

/// `whole`: the range ends on ticks. A range that is none, or not finite, becomes 0..1.
AxisTicks axisTicks(double low, double high, int wanted, bool whole);

}  // namespace app
