// Numbers as people read them: "0.41", "12". Any thread.
#pragma once

#include <string>

namespace app {

std::string inWords(double number, int decimals);
inline std::string inMm(double length_mm) { return inWords(length_mm, length_mm < 10.0 ? 2 : 1) + " mm"; }

}  // namespace app
