// printf into a string of at most 255 bytes: one line of a summary or a panel. Any thread.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace app {

[[gnu::format(printf, 1, 2)]] inline std::string printed(const char* format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace app
