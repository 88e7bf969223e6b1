// The middle of some values, the upper one of an even number. Any thread; linear time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace calibration {

/// Of one value or more.
template <class Value>
Value medianOf(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace calibration
