// What can go wrong in a tick, as bits: each a trip that is counted, recorded and said in words (safety/trips). All but
// `clamped`, `slewed`, `joints` and `hot` take the force away or lower it; `clamped` to `hot` only hold it within
// limits.
#pragma once

#include <cstdint>

namespace haptics {

enum class Fault : std::uint32_t {
  none = 0,
  bad_pose = 1,   ///< the device gave a non-finite or absurd pose
  bad_force = 2,  ///< the law gave a non-finite force
  clamped = 4,    ///< magnitude limit reached
  slewed = 8,     ///< rate limit reached
  device = 16,    ///< the device reported trouble
};
constexpr Fault operator|(Fault a, Fault b) {
  return static_cast<Fault>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool has(Fault set, Fault one) {
  return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(one)) != 0;
}

}  // namespace haptics
