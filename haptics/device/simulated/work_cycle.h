// The script of a whole session at a device: the handle lies at rest; the hand takes it, moves along given points to
// above the work, waits there so that the device can be armed, works, and puts it back. Frame D, mm, s. A pure function
// of time; any thread. The pedal is down at work only.
#pragma once

#include <vector>

#include "haptics/device/simulated/hand_script.h"
#include "haptics/device/simulated/trough_path.h"

namespace haptics {

class WorkCycle {
 public:
  /// `rest`: pose of the handle in the device; `way`: points to pass on the way from there to the work.
  WorkCycle(const TroughPath& work, const HandTarget& rest, const std::vector<glm::dvec3>& way);

  HandTarget at(double t_s) const;
  double duration_s() const { return duration_s_; }

 private:
  /// Between two points, at rest at both.
  struct Leg {
    glm::dvec3 from_mm, to_mm;
    double begins_s, takes_s;
  };
  HandTarget onTheWay(double t_s) const;

  TroughPath work_;
  HandTarget rest_, start_;
  std::vector<Leg> legs_;
  double way_s_ = 0.0, works_s_ = 0.0, leaves_s_ = 0.0, duration_s_ = 0.0;
};

}  // namespace haptics
