// Numbers as people read them: "0.41", "12". Any thread.
#pragma once

#include <string>

namespace app {

std::string numberText(double number, int decimals);
inline std::string mmText(double length_mm) { return numberText(length_mm, length_mm < 10.0 ? 2 : 1) + " mm"; }

}  // namespace app
