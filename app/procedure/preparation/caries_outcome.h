// What an excavation has come to: soft and firm caries that are left, sound tissue that was cut, and how near the cut
// has come to the pulp. Soft (infected) caries is to be removed, firm (affected) may stay over the pulp. mm, mm³. Frame
// P. Any thread; the way to the pulp is made once (some 0.4 s), then 30 ms.
#pragma once

#include <limits>
#include <vector>

#include "app/procedure/preparation/crown.h"

namespace app {

struct CariesOutcome {
  double soft_before_mm3 = 0.0, firm_before_mm3 = 0.0;
  double soft_left_mm3 = 0.0, firm_left_mm3 = 0.0;
  double sound_cut_mm3 = 0.0;  ///< enamel and dentine
  /// Between what was cut and the pulp, the least; NaN: nothing was cut, or the tooth has no pulp.
  double least_over_pulp_mm = std::numeric_limits<double>::quiet_NaN();
};

class CariesMeasure {
 public:
  explicit CariesMeasure(const Crown& crown);

  /// Whether the tooth has any.
  bool isThere() const { return !to_pulp_mm_.empty(); }
  CariesOutcome outcomeOf(const Crown& crown, const BoxBytes& made) const;

 private:
  std::vector<float> to_pulp_mm_;  ///< in the order of the crown's box; infinite: it has none
};

}  // namespace app
