// What a force law remembers from tick to tick: the densities it met (points) and the place it holds to (forssim). The
// servo owns one and passes it in; contactOf only reads it, however often a proxy looks in a tick, and `updateLawState`
// takes in the last look of the tick. Start anew when law or tool changes. Trivially copyable, fixed size; servo
// thread.
#pragma once

#include <array>
#include <cstddef>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

/// Mean of the last hundred values. A hundred ticks are as Gajananan has it, at 1 kHz a tenth of a second.
class MovingMean {
 public:
  static constexpr std::size_t kLength = 100;

  void push(double value) {
    value_[next_] = value;
    next_ = (next_ + 1) % kLength;
    if (count_ < kLength) ++count_;
  }
  /// None yet: the value itself.
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
  MovingMean density;  ///< points: of what was met, one value a tick in contact
  bool holding = false;
  calibration::Point<calibration::Patient> held_P;  ///< forssim: where the spring of the hold ends
};

}  // namespace haptics
