// Expected tip error at a point after a rigid fit: small amid the targets, growing outside; shows where more touches
// are needed. TRE^2 = FLE^2 / N (1 + 1/3 sum_k d_k^2 / f_k^2), d_k and f_k the distances of the point and of the
// targets from their k-th principal axis. Frame W, mm. Any thread; a few flops. Not a measured error. Source:
// Fitzpatrick, West, Maurer, IEEE TMI 17, 1998, eq. 46.
#pragma once

#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace calibration {

class ExpectedErrorMap {
 public:
  /// `fle_mm`: RMS fiducial localisation error of one touch.
  ExpectedErrorMap(const std::vector<Point<World>>& targets_W, double fle_mm);
  double at_mm(const Point<World>& position_W) const;

 private:
  glm::dvec3 middle_mm_{0.0};
  glm::dmat3 axes_{1.0};
  glm::dvec3 spread_mm2_{1.0};  ///< f_k^2
  double fle_mm_ = 0.0;
  double count_ = 1.0;
};

}  // namespace calibration
