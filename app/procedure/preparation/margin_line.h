// P4: the margin of a prepared crown, direction by direction (reference/sisters 5.3): where the untouched surface ends
// below the cut, and how wide the shelf is from there to the wall, drawn down as a line so that a round inner angle
// does not count. Square to the outline. Frame of the tooth, mm. Pure; any thread; microseconds.
#pragma once

#include <array>

#include "app/procedure/preparation/stump_walls.h"

namespace app {

struct MarginLine {
  std::array<double, StumpWalls::kAround> height_mm{};  ///< NaN: nothing was cut there
  std::array<double, StumpWalls::kAround> width_mm{};   ///< NaN: no wall
  double mean_mm = StumpWalls::kNone;
  double waviness_mm = 0.0;  ///< standard deviation of the width
  double least_mm = 0.0, most_mm = 0.0;
  double missing_share = 1.0;  ///< of all directions: uncut, or a shelf below 0.3 mm
  double off_height_mm = 0.0;  ///< mean of the height, over the one that was wanted
};

/// Heights alone, as a form of walls asks for them.
std::array<double, StumpWalls::kAround> marginHeights_mm(const StumpWalls& before, const StumpWalls& after);

MarginLine marginLine(const StumpWalls& before, const std::array<double, StumpWalls::kAround>& heights_mm,
                      const WallForm& form, double wanted_height_mm);

}  // namespace app
