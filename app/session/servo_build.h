// What the bits of a tick depend on besides bone, hand and commands: the servo's revision and the instruction set of
// its sums. Plain values; any thread.
#pragma once

#include <cstdint>
#include <string>

namespace app {

struct ServoBuild {
  std::int64_t revision = 0;    ///< haptics::kServoRevision; 0: recorded before it was stored
  std::string instruction_set;  ///< assets::nameOf; empty: not stored

  /// AVX2 and AVX-512 sums are identical; those of portable code differ (haptics/README).
  bool sumsIdentically(const ServoBuild& other) const;
};

ServoBuild thisServo();

}  // namespace app
