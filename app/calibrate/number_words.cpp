#include "app/calibrate/number_words.h"

#include <fmt/core.h>

namespace app {

std::string inWords(double number, int decimals) { return fmt::format("{:.{}f}", number, decimals); }

}  // namespace app
