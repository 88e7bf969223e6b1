// What the program says to the person at the terminal, a line on standard error. Any thread.
#pragma once

#include <cstdio>
#include <string>

namespace app {

inline void printMessage(const std::string& line) { std::fprintf(stderr, "molar: %s\n", line.c_str()); }

}  // namespace app
