// State of a force law from tick to tick: mean density (points) and the hold's end point (forssim). The servo owns one
// and passes it in; contactOf only reads it, updateLawState takes the last evaluation of a tick. Reset when law or tool
// changes. Trivially copyable, fixed size; servo thread.
#pragma once

#include <array>
#include <cstddef>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

/// Mean of the last hundred values: a tenth of a second at 1 kHz (Gajananan).
class MovingMean {
 public:
  static constexpr std::size_t kLength = 100;

  void push(double value) {
    value_[next_] = value;
    next_ = (next_ + 1) % kLength;
    if (count_ < kLength) ++count_;
  }
  /// The mean; `value` itself before the first.
  double with(double value) const {
    if (count_ == 0) return value;
    double sum = 0.0;
    for (std::size_t i = 0; i < count_; ++i) sum += value_[i];
    return sum / static_cast<double>(count_);
  }

 private:
  std::array<double, kLength> value_{};
  std::size_t next_ = 0, count_ = 0;
};

struct LawState {
  MovingMean density;  ///< points: one value a tick in contact
  bool holding = false;
  calibration::Point<calibration::Patient> held_P;  ///< forssim: end of the hold's spring
};

}  // namespace haptics
