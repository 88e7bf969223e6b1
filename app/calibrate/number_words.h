// Numbers as people read them: "0.41", "12". Any thread.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace app {

inline std::string inWords(double number, int decimals) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, number);
  return text.data();
}
inline std::string inMm(double length_mm) { return inWords(length_mm, length_mm < 10.0 ? 2 : 1) + " mm"; }

}  // namespace app
