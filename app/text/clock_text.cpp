#include "app/text/clock_text.h"

#include <algorithm>

#include <fmt/core.h>

namespace app {

std::string clockText(double time_s) {
  const auto seconds = static_cast<long>(std::max(0.0, time_s));
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

}  // namespace app
