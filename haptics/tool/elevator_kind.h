// The elevators: levers that loosen a tooth. Their blades: ligament/elevator_shape.h. Part of a Tool; any thread.
#pragma once

#include <cstdint>

namespace haptics {

enum class ElevatorKind : std::uint8_t {
  none = 0,
  straight_301 = 1,  ///< blade 3 mm wide
  straight_34s = 2,  ///< blade 4 mm wide
  cryer_left = 3,    ///< a triangle across the shank, its tip towards -x of T
  cryer_right = 4,   ///< its mirror image
};

}  // namespace haptics
