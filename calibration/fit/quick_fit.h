// Preliminary fit while touches come in: pose, offsets of all joints and the tip, 15 parameters under wide priors, with
// outliers down-weighted; and the leave-one-out error of each touch by linearisation. Flags doubtful touches and shows
// the tip approximately; the final arm is fitArm's. Frame W, mm, rad. Any thread but the servo's; allocates; some
// milliseconds for 27 touches.
#pragma once

#include <vector>

#include "calibration/fit/touches.h"

namespace calibration {

struct QuickFit {
  MeasuredArm arm;
  std::vector<Vector<World>> left_out_mm;  ///< one per touch, in order
  std::vector<bool> doubtful;              ///< left-out error beyond three robust sigmas of all
  double median_mm = 0.0;                  ///< of the residuals
};

/// `start`: the current arm. Fewer than 4 touches return it unchanged and flag nothing.
QuickFit quickFit(const MeasuredArm& start, const TouchSet& touches);

}  // namespace calibration
