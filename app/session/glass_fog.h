// What veils the glass of the mirror in the second hand: breath while it is held in the mouth, drops of the drill's
// spray near the site. The spray's water rinses off breath; once it ends the assistant's air dries the drops; outside
// the mouth breath clears. First-order rates, solved in closed form over a step, as field_clarity.h. Pure: the
// same steps give the same state. Shares 0..1; mm, s; frame P. Any thread. Rates are our own choice: no measurement is
// known.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace app {

class GlassFog {
 public:
  struct Around {
    double from_site_mm = 0.0;  ///< the glass's centre
    bool drilling = false, irrigating = false;
  };

  /// Goes on to `t_s`; what is around it held since the last step.
  void step(double t_s, const Around& around);
  /// Of the light that it veils.
  double share() const { return breath_ + drops_ - breath_ * drops_; }

 private:
  double t_s_ = 0.0, breath_ = 0.0, drops_ = 0.0;
};

}  // namespace app
