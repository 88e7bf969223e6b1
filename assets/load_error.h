// The one exception of this folder: bad input or a file that can not be written.
// The text is one line: what, where, what to do. Never carries patient identifiers.
#pragma once

#include <stdexcept>

namespace assets {

struct LoadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace assets
