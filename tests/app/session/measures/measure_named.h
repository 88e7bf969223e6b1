// A measure among others by its id. Test code only.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "app/session/measures/measure_value.h"

namespace app::test {

/// The id must be there.
inline const MeasureValue& named(const std::vector<MeasureValue>& values, std::string_view id) {
  return *std::ranges::find(values, id, &MeasureValue::id);
}
/// It must have a value.
inline double valueNamed(const std::vector<MeasureValue>& values, std::string_view id) {
  return named(values, id).value.value();
}

}  // namespace app::test
