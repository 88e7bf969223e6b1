// What sets by itself (settingOf: amalgam, glass ionomer), once its increment has been in the tooth for its time.
// Blocks take turns, some each tick, so that the work of a tick is bounded: all of a tooth within some two seconds. It
// is the material's doing, not a stroke: undo leaves it, and what undo brings back has set again a turn later. The
// thread that owns the filling; under 10 us a tick, some ns while nothing is due; no allocation, no throw.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/bone/filling.h"

namespace haptics {

/// By increment, s.
using IncrementAges = std::array<double, Filling::kMostIncrements + 1>;

/// Part of the servo's state.
class Hardening {
 public:
  static constexpr int kBlocksPerTick = 4, kLookedAtPerTick = 512;

  /// A tick. Returns the steps of 1/255 of a voxel that have set.
  std::int64_t step(Filling& filling, const IncrementAges& age_s) noexcept;

 private:
  std::size_t next_ = 0;  ///< block
};

}  // namespace haptics
