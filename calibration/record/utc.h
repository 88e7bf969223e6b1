// UTC times of records: "2026-11-21T08:20:00Z", whole seconds. Pure except nowUtc; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace calibration {

/// Since 1970; none: not a time.
std::optional<std::int64_t> secondsOfUtc(std::string_view text);
std::string utcOf(std::int64_t seconds);

std::string nowUtc();  ///< by the system clock

}  // namespace calibration
