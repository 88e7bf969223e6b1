// A first idea of the arm while its touches still come in: pose, offsets of all joints and the tip, 15 parameters under
// wide priors, wild touches without a say; and for each touch the error the others foretell for it (leave-one-out, by
// the fit's own linear form). To name doubtful touches and to show the tip nearly where it is; what is kept is made by
// fitArm. Frame W, mm, rad. Any thread but the servo's; allocates; some milliseconds for 27 touches.
#pragma once

#include <vector>

#include "calibration/fit/touches.h"

namespace calibration {

struct QuickFit {
  MeasuredArm arm;
  std::vector<Vector<World>> left_out_mm;  ///< one a touch, in their order
  std::vector<bool> doubtful;              ///< its left-out error is beyond three robust sigma of all of them
  double median_mm = 0.0;                  ///< of what is left at the touches
};

/// `start`: the arm as it is believed. For 4 touches or more; fewer leave `start` as it is and nothing in doubt.
QuickFit quickFit(const MeasuredArm& start, const TouchSet& touches);

}  // namespace calibration
