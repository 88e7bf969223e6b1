// What covers the operated site and how much of it the surgeon can see: a film of water, blood of cut marrow, dust of
// dry cutting, the spray of the irrigation; cleared by water and by the assistant's suction, which never pauses.
// First-order rates, solved in closed form over a step: measures step it tick by tick, the picture frame by frame.
// Pure: the same steps give the same state. Shares 0..1; mm, mm³, s; frame P. Any thread; under a microsecond. Rates:
// straight handpiece with 30 to 50 mL/min of saline, our own choice where no measurement is known.
#pragma once

#include "calibration/geometry/pose.h"
#include "haptics/servo/tick.h"

namespace app {

struct FieldCover {
  double water = 0.35, blood = 0.15, dust = 0.0, spray = 0.0;

  /// Share of the cut that is seen through dust, blood and spray.
  double clarity() const;
};

class FieldClarity {
 public:
  /// `centre_P`: where the site lies before the first cut.
  explicit FieldClarity(const calibration::Point<calibration::Patient>& centre_P = {}) : centre_P_(centre_P) {}

  /// Goes on to the end of `tick`, whose inputs held since the last one; `irrigating`: of the command in force.
  void step(const haptics::Tick& tick, bool irrigating);

  const FieldCover& cover() const { return cover_; }
  /// About where bone or tooth was removed last.
  const calibration::Point<calibration::Patient>& centre_P() const { return centre_P_; }
  /// Distance at which the cover has fallen to 1/e; grows with what was removed.
  double reach_mm() const;

 private:
  FieldCover cover_;
  double t_s_ = 0.0;
  double chips_mm3_ = 0.0;  ///< lying on the site
  double removed_mm3_ = 0.0, marrow_mm3_ = 0.0;
  calibration::Point<calibration::Patient> centre_P_;
};

}  // namespace app
