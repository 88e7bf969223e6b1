// Median, the upper one of an even number of values. Any thread; linear time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace calibration {

/// At least one value.
template <class Value>
Value medianOf(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace calibration
