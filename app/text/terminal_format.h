// How wide and how colourful a page of words may be where it is read: a terminal, or a file. NO_COLOR (no-color.org)
// is obeyed. Any thread.
#pragma once

#include <cstddef>

namespace app {

struct TerminalFormat {
  std::size_t width = 100;  ///< columns
  bool coloured = false;
};

/// Of standard output.
TerminalFormat terminalFormat();

}  // namespace app
