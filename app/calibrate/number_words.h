// Numbers as people read them: "0.41", "12". Any thread.
#pragma once

#include <string>

#include "app/text/printed.h"

namespace app {

inline std::string inWords(double number, int decimals) { return printed("%.*f", decimals, number); }
inline std::string inMm(double length_mm) { return inWords(length_mm, length_mm < 10.0 ? 2 : 1) + " mm"; }

}  // namespace app
