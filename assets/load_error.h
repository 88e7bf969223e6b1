// The exception of this folder: invalid input, or a file that cannot be written.
// The text is one line: what, where, what to do. It never contains patient identifiers.
#pragma once

#include <stdexcept>

namespace assets {

struct LoadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace assets
