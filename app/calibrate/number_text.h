// Lengths as text on the wizard's pages. Any thread.
#pragma once

#include "app/report/markup.h"

namespace app {

inline std::string mmText(double length_mm) { return fixedText(length_mm, length_mm < 10.0 ? 2 : 1) + " mm"; }

}  // namespace app
