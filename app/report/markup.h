// Text for HTML and SVG, numbers and times for print. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

namespace app {

/// Escaped for text and attributes.
std::string escaped(std::string_view text);
/// `digits` after the point; a typographic minus, none before zero.
std::string fixedText(double value, int digits);
/// The same with a plus before positive values.
std::string signedText(double value, int digits);
/// No finer than it means something to a reader: 1.23, 12.3, 123.
std::string shortText(double value);
/// "2026-11-21T08:20:00Z" as "2026-11-21 08:20 UTC"; other text unchanged.
std::string timeText(const std::string& utc);

}  // namespace app
