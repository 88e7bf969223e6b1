// Text as HTML and SVG take it, numbers and times as in print. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

namespace app {

/// For use in text and in attributes.
std::string escaped(std::string_view text);
/// With so many digits after the point. A true minus, as in print, and none before a zero.
std::string fixedText(double value, int digits);
/// "2026-11-21T08:20:00Z" as people read it: "2026-11-21 08:20 UTC"; what is no time as it is.
std::string timeText(const std::string& utc);

}  // namespace app
