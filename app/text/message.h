// Messages to the person at the terminal, one line each on standard error. Any thread.
#pragma once

#include <cstdio>
#include <functional>
#include <string>

namespace app {

inline void printMessage(const std::string& line) { std::fprintf(stderr, "molar: %s\n", line.c_str()); }

/// Receives one message.
using ReportLine = std::function<void(const std::string& line)>;

}  // namespace app
