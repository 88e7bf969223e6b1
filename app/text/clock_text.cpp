#include "app/text/clock_text.h"

#include <algorithm>
#include <ctime>

#include <fmt/chrono.h>

namespace app {

std::string clockText(double time_s) {
  // A sum of ticks may lack a trillionth of the whole second that it means.
  constexpr double kRounding_s = 1e-6, kMost_s = 1e12;
  const auto seconds = static_cast<long>(std::min(kMost_s, std::max(0.0, time_s + kRounding_s)));
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

std::string localDateTime(std::int64_t unix_s) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm local{};
  localtime_r(&seconds, &local);
  return fmt::format("{:%Y-%m-%d %H:%M}", local);
}

}  // namespace app
