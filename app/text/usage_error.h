// The exception of app: invalid command line, pose file or answer. One line: what, where, what to do. Caught in main,
// exit 2.
#pragma once

#include <stdexcept>

namespace app {

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
