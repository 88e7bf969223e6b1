#include "calibration/record/utc.h"

#include <charconv>
#include <chrono>

#include <fmt/chrono.h>

namespace calibration {
namespace {

constexpr std::size_t kLength = std::string_view("0000-00-00T00:00:00Z").size();

int numberIn(std::string_view text, std::size_t at, std::size_t digits) {
  int value = 0;
  std::from_chars(text.data() + at, text.data() + at + digits, value);
  return value;
}

}  // namespace

std::optional<std::int64_t> secondsOfUtc(std::string_view text) {
  if (text.size() != kLength || text[0] == '-') return std::nullopt;
  const std::chrono::year_month_day day{std::chrono::year(numberIn(text, 0, 4)),
                                        std::chrono::month(static_cast<unsigned>(numberIn(text, 5, 2))),
                                        std::chrono::day(static_cast<unsigned>(numberIn(text, 8, 2)))};
  const int hour = numberIn(text, 11, 2), minute = numberIn(text, 14, 2), second = numberIn(text, 17, 2);
  if (!day.ok()) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(day).time_since_epoch().count();
  const std::int64_t seconds = ((days * 24 + hour) * 60 + minute) * 60 + second;
  return utcOf(seconds) == text ? std::optional(seconds) : std::nullopt;  // refuses any other spelling
}

std::string utcOf(std::int64_t seconds) {
  return fmt::format("{:%FT%TZ}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

std::string nowUtc() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return utcOf(now.time_since_epoch().count());
}

}  // namespace calibration
