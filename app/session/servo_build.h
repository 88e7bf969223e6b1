// What the bits of a tick depend on beside bone, hand and commands: which servo, and by which of the machine's
// instructions its sums were made. Plain values; any thread.
#pragma once

#include <cstdint>
#include <string>

namespace app {

struct ServoBuild {
  std::int64_t revision = 0;    ///< haptics::kServoRevision; 0: recorded before sessions told
  std::string instruction_set;  ///< assets::nameOf it; empty: the same

  /// AVX2 and AVX-512 sum alike, portable code does not (haptics/README).
  bool sumsIdentically(const ServoBuild& other) const;
};

ServoBuild thisServo();

}  // namespace app
