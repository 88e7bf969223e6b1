// What the tables of parameters (erosion, laws) have in common: a row finds its value in the settings by a pointer to
// members, and all rows of a table are clamped at once. Everything is unrolled at compile time: on the servo thread
// nothing is called through a pointer. Include in the tables' sources alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace haptics {

template <auto Law, auto Parameter, class Settings>
double& valueIn(Settings& settings) {
  return settings.*Law.*Parameter;
}

/// Every value of kTable's rows within its range, its default where it is no number.
template <const auto& kTable, class Settings>
void clampToTable(Settings& safe) {
  Settings standard;
  const auto clamp_row = [&]<std::size_t kRow>() {
    constexpr auto kIn = kTable[kRow].in;
    double& value = kIn(safe);
    value = std::isfinite(value) ? std::clamp(value, kTable[kRow].lowest, kTable[kRow].highest) : kIn(standard);
  };
  [&]<std::size_t... kRow>(std::index_sequence<kRow...>) { (clamp_row.template operator()<kRow>(), ...); }
  (std::make_index_sequence<kTable.size()>{});
}

}  // namespace haptics
