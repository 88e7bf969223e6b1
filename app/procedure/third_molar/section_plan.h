// The slot that parts an impacted lower third molar: from cheek to tongue through the crown to between the roots. Of
// the planes along which a bur can come, and that leave a third of the tooth on either side, the one with the least to
// cut; off the second molar and the mandibular canal. Every plan is tried on a copy of the tooth. Frame P, mm. Any
// thread; some tenths of a second; allocates.
#pragma once

#include <optional>

#include "app/procedure/third_molar/site_solid.h"

namespace app {

struct PlannedSection {
  assets::PlannedCut cut;
  double largest_mm3 = 0.0;    ///< the largest piece of the tooth after it
  double off_tongue_mm = 0.0;  ///< of the bur from the jaw's surface towards the tongue, at the nearest; <= 0: a hole
};

/// `overshoot_mm`: how far the bur goes beyond the tooth on the tongue's side and below its fork. None: there is no
/// tooth to part, or no way to it.
std::optional<PlannedSection> planSection(const SiteSolid& site, double bur_radius_mm, double overshoot_mm,
                                          const Margins& margins = {});

}  // namespace app
