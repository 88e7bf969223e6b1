// The one exception of sessions: a file that can not be written, or one that is not a readable session.
// The text is one line: what, where, what to do.
#pragma once

#include <stdexcept>

namespace app {

struct SessionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
