// The elevators: levers that loosen a tooth. Their blades: ligament/elevator_shape.h. Part of a Tool; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace haptics {

enum class ElevatorKind : std::uint8_t {
  none = 0,
  straight_301 = 1,  ///< blade 3 mm wide
  straight_34s = 2,  ///< blade 4 mm wide
  cryer_left = 3,    ///< a triangle across the shank, its tip towards -x of T
  cryer_right = 4,   ///< its mirror image
};

/// As ordered and recorded, in the order of the kinds.
inline constexpr std::array<std::string_view, 5> kElevatorKeys{"none", "301", "34s", "cryer-left", "cryer-right"};

}  // namespace haptics
