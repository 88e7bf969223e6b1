// What a tooth bites on: the lowest surface of the opposing teeth where they end up when the jaws are closed on intact
// teeth. Where a case has one jaw alone it is made of the intact tooth's own biting surface: smoothed, and lowered onto
// it until it rests on three places around the middle, as a tripod. Made once, some 0.1 s. Frame of the tooth, mm.
// Plain values; any thread.
#pragma once

#include "app/procedure/preparation/occlusal_heights.h"

namespace app {

struct Antagonist {
  OcclusalRaster height_mm;  ///< closed; none: nothing opposes there
  bool is_made = true;       ///< not of a scan: told wherever it is shown
};

/// For people, wherever a made one is shown.
inline constexpr char kMadeAntagonist[] = "opposing tooth made, not scanned";

/// `intact`: of the tooth before anything was cut.
Antagonist madeAntagonist(const OcclusalRaster& intact);

}  // namespace app
