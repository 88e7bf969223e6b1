// The whole instrument as balls along its axis: head, shaft, handpiece if there is one, as they are drawn. For contact
// with soft tissue, whose field is coarse. Frame T; mm. The balls stay inside the drawn outline and cover it within a
// twelfth of the local radius. Fixed size, no allocation; any thread; some 100 ns.
#pragma once

#include <array>
#include <cstddef>

#include "haptics/tool/tool.h"

namespace haptics {

struct InstrumentOutline {
  static constexpr std::size_t kMaxBalls = 80;
  struct Ball {
    double z_mm = 0.0, radius_mm = 0.0;
  };
  std::array<Ball, kMaxBalls> balls{};
  std::size_t count = 0;       ///< from the tip to the coupling
  std::size_t head_count = 0;  ///< the first of them are the head

  std::size_t size() const { return count; }
};

/// `tool` sanitised.
InstrumentOutline outlineOf(const Tool& tool) noexcept;

}  // namespace haptics
