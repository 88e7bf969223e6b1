// The exception of this folder: invalid input, or a file that cannot be written.
// The text is one line: what, where, what to do. It never contains patient identifiers.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace assets {

struct LoadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Text from a file for a message: at most `max_length` bytes, control characters replaced.
inline std::string printable(std::string text, std::size_t max_length, char replacement = '?') {
  text.resize(std::min(text.size(), max_length));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7f; }, replacement);
  return text;
}

}  // namespace assets
