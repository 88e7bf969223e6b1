// The exception of this folder: a rig, image or measurement that cannot be used. The text is one line: what, where,
// what to do.
#pragma once

#include <stdexcept>

namespace calibration {

struct CalibrationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace calibration
