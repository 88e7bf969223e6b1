// Nesting depth of a JSON text, checked before parsing: recursive parsers overflow the stack on deeply nested input.
// Any thread; O(text).
#pragma once

#include <string_view>

namespace assets {

/// Deeper than 128; no file this program reads is.
inline bool isNestedTooDeep(std::string_view json) {
  constexpr int kDeepest = 128;
  int depth = 0;
  bool in_string = false;
  for (std::size_t at = 0; at < json.size() && depth <= kDeepest; ++at) {
    const char c = json[at];
    if (c == '"') in_string = !in_string;
    if (in_string && c == '\\') ++at;
    if (!in_string && (c == '[' || c == '{')) ++depth;
    if (!in_string && (c == ']' || c == '}')) --depth;
  }
  return depth > kDeepest;
}

}  // namespace assets
