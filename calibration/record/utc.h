// Times as records have them: "2026-11-21T08:20:00Z", whole seconds, UTC, the Gregorian calendar. Pure, nowUtc aside;
// any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace calibration {

/// Since 1970; none for what is no time.
std::optional<std::int64_t> secondsOfUtc(std::string_view text);
std::string utcOf(std::int64_t seconds);

std::string nowUtc();  ///< by the system's clock

}  // namespace calibration
