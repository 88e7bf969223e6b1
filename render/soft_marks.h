// What the instrument has done to soft tissue, in a frame: cuts by a turning bur, which stay, and places that were
// pressed and are red for a while. A cut is a swept ball: gingiva inside of it is gone, its rim and other soft tissue
// are a dark wound. Bounded lists; app makes them from the servo's ticks (app/rehearsal/soft_mark_trail.h). Frame P,
// mm. Plain data; any thread.
#pragma once

#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace render {

/// Further entries are not drawn.
inline constexpr std::size_t kMostSoftCuts = 64, kMostReddened = 8;

struct SoftCut {
  calibration::Point<calibration::Patient> from_P, to_P;
  double radius_mm = 0.0;
};

struct Reddened {
  calibration::Point<calibration::Patient> place_P;
  double reach_mm = 0.0;  ///< the redness falls to 1/e at this distance
  double share = 0.0;     ///< 0..1
};

struct SoftMarks {
  std::vector<SoftCut> cuts;
  std::vector<Reddened> reddened;
};

}  // namespace render
