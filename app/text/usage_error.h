// The one exception of this folder: a command line, pose file or answer that can not be used.
// The text is one line: what, where, what to do. Caught once, in main: exit 2.
#pragma once

#include <stdexcept>

namespace app {

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
