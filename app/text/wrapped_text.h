// Text broken at blanks into lines of at most so many columns, the second and later ones indented. A word that is
// longer than a line stays whole, so that a command can be copied. Counts UTF-8 characters, not bytes. Any thread.
#pragma once

#include <string>
#include <string_view>

namespace app {

/// The first line begins at column `indent` already.
std::string wrappedText(std::string_view text, std::size_t indent, std::size_t width);

}  // namespace app
