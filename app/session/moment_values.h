// The figures of one moment of a session, as its servo run again gives them: `molar replay --to T --json` and the
// evaluator's page print the same bits. N, mm³, s. Pure; any thread; nanoseconds.
#pragma once

#include <cstdint>
#include <string>

#include "haptics/servo/tick.h"

namespace app {

struct MomentValues {
  std::uint64_t tick = 0;  ///< the last one that began before the moment
  double t_s = 0.0;        ///< when it began
  double force_N = 0.0;    ///< on the hand, as commanded to the device
  double removed_mm3 = 0.0;
  std::uint64_t bone_digest = 0;
};

/// Before the first tick: all 0.
MomentValues valuesOf(const haptics::Tick& tick);

/// One object; numbers with every digit they need, the digest as 16 hexadecimal digits.
std::string momentJson(const MomentValues& values);

}  // namespace app
