// Cortical bone and dentine as this scan shows them, whatever its scale: cortical is the median of the jaw's outer
// shell far below the bite, dentine the first peak above it in the histogram of hard tissue. Every further threshold is
// made from these two. Hounsfield. Any thread but the servo; 0.3 s.
#pragma once

#include "assets/segment/mandible.h"

namespace assets {

struct GreyLevels {
  double cortical_hu = 1200.0, dentine_hu = 1600.0;

  double tooth_hu() const { return 0.5 * (cortical_hu + dentine_hu); }  ///< above: dense as a tooth
  double enamel_hu() const { return dentine_hu + 350.0; }               ///< above: surely enamel
  double thinBone_hu() const { return 0.5 * cortical_hu + 150.0; }      ///< above: cortical, below: trabecular
};

GreyLevels greyLevelsOf(const Mandible& jaw, const BiteSheet& sheet);

}  // namespace assets
