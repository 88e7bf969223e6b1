#include "app/calibrate/number_text.h"

#include <fmt/core.h>

namespace app {

std::string numberText(double number, int decimals) { return fmt::format("{:.{}f}", number, decimals); }

}  // namespace app
