// What a bridge of tooth comes to when it breaks: made on a worker (bridge_break.h), carried out by the servo block by
// block like any other split. Frame and mm of the tooth's grid. Plain values.
#pragma once

#include <cstdint>

#include "haptics/body/bridge.h"
#include "haptics/body/split_plan.h"

namespace haptics {

struct BreakPlan {
  SplitPlan split;            ///< what comes off; voxels at the break in part
  Bridge bridge;              ///< that breaks
  double enamel_share = 0.0;  ///< of the broken surface
  bool is_complete = true;    ///< false: the break turned aside and left a spur on the root
  std::uint64_t digest = 0;   ///< of the split and what is measured here: equal plans have equal ones

  bool operator==(const BreakPlan&) const = default;
};

}  // namespace haptics
