// A length of time as a clock shows it, and a moment as a calendar does. Any thread.
#pragma once

#include <cstdint>
#include <string>

namespace app {

/// "1:05", whole seconds that have passed; minutes go on beyond an hour: "61:00".
std::string clockText(double time_s);

/// "2026-11-24 15:43", local time.
std::string localDateTime(std::int64_t unix_s);

}  // namespace app
