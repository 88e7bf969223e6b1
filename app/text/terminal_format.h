// Width and colour of text on standard output: a terminal or a file. Follows NO_COLOR (no-color.org). Any thread.
#pragma once

#include <cstddef>

namespace app {

struct TerminalFormat {
  std::size_t width = 100;  ///< columns
  bool coloured = false;
};

TerminalFormat terminalFormat();

}  // namespace app
