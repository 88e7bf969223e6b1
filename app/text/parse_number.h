// Text to number, independent of the locale: 1.5, -3, 1e4. Any thread.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <string_view>

namespace app {

/// None unless the whole text is a finite number that fits. `how`: base of an integer.
template <class Number>
std::optional<Number> parseNumber(std::string_view text, auto... how) {
  Number number{};
  const char* const behind = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), behind, number, how...);
  if (error != std::errc{} || end != behind) return std::nullopt;
  if constexpr (std::floating_point<Number>)
    if (!std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace app
