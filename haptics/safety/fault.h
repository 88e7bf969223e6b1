// Actions of the safety layer in a tick, as bits: each is a trip that is counted, recorded with its tick and has a text
// (safety/trips). From `clamped` to `hot` the force is held within limits; all others lower it or switch it off.
#pragma once

#include <cstdint>

namespace haptics {

enum class Fault : std::uint32_t {
  none = 0,
  bad_pose = 1,      ///< the device gave a non-finite or absurd pose
  bad_force = 2,     ///< the law gave a non-finite force
  clamped = 4,       ///< magnitude limit reached
  slewed = 8,        ///< rate limit reached
  device = 16,       ///< the device reported trouble
  joints = 32,       ///< a joint's torque limit reached
  hot = 64,          ///< limited by the motors' heat
  stale = 128,       ///< no measurement for 3 ms or longer
  resumed = 256,     ///< the ticks had paused
  braked = 512,      ///< damped: the hand was fast
  too_fast = 1024,   ///< no force for 0.1 s: the hand was too fast
  buzz = 2048,       ///< the contact oscillated
  overdrawn = 4096,  ///< the hand got more energy than a ramp can take back
  let_go = 8192,     ///< the deadman detected no hand
  latched = 16384,   ///< no force until the instructor clears it
  stopped = 32768,   ///< emergency stop
};
constexpr Fault operator|(Fault a, Fault b) {
  return static_cast<Fault>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr Fault without(Fault of, Fault one) {
  return static_cast<Fault>(static_cast<std::uint32_t>(of) & ~static_cast<std::uint32_t>(one));
}
constexpr bool has(Fault set, Fault one) {
  return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(one)) != 0;
}

}  // namespace haptics
