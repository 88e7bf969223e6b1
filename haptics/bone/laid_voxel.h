// How filling gets into a voxel of a block's state. Private to bone/; servo thread; some ns, no allocation, no throw.
#pragma once

#include <algorithm>
#include <cstdint>

#include "haptics/bone/filling.h"

namespace haptics {

inline std::uint16_t markOf(unsigned increment) {
  return static_cast<std::uint16_t>(std::min(increment, Filling::kMostIncrements) << Filling::kIncrementShift);
}

/// More of a material in a voxel; the larger part names it.
inline void addLaid(BlockState& state, std::size_t n, int more, std::uint8_t material, std::uint16_t mark) {
  if (more == 0) return;
  if (more >= state.solid[n]) state.reach[n] = material, state.dose[n] = mark;
  state.solid[n] = static_cast<std::uint8_t>(state.solid[n] + more);
}

}  // namespace haptics
