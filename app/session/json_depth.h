// How deep a text of JSON is nested, judged before it is parsed: what walks lists in lists by calling itself ends the
// program where a stranger's text goes deep enough. Any thread; O(text).
#pragma once

#include <string_view>

namespace app {

/// Deeper than 64, which no text of a session is.
bool isNestedTooDeep(std::string_view json);

}  // namespace app
