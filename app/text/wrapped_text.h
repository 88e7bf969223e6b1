// Text wrapped at blanks, later lines indented. Words longer than a line stay whole, so that commands can be copied.
// Columns are UTF-8 characters. Any thread.
#pragma once

#include <string>
#include <string_view>

namespace app {

/// The first line begins at column `indent`.
std::string wrappedText(std::string_view text, std::size_t indent, std::size_t width);

}  // namespace app
