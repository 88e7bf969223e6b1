// How deep a text of JSON is nested, judged before it is parsed: what walks lists in lists by calling itself ends the
// program where a stranger's text goes deep enough. Any thread; O(text).
#pragma once

#include <string_view>

namespace assets {

/// Deeper than 128, which no file is that this program reads.
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
