// FDI numbers of the teeth found in a lower jaw. From the right to the left along the arch they are matched to the
// sequence 48..41, 31..38 so that sizes and the distances along the arch fit best, teeth and numbers left out included
// (dynamic programming over the pairs, as sequences are aligned). A part that fits no number joins the tooth it touches
// most if that brings its volume nearer to what is usual (a root that was divided from its crown), or keeps none.
// Widths and volumes of lower teeth: Wheeler; third molars vary most. A proposal: confirmed by a person. Any thread but
// the servo; 10 ns a voxel.
#pragma once

#include <vector>

#include "assets/segment/jaw_arch.h"
#include "assets/segment/tooth_regions.h"

namespace assets {

struct FoundTooth {
  int part = 0;  ///< in ToothRegions
  double volume_mm3 = 0.0;
  glm::dvec3 centre_P_mm{0.0}, extent_mm{0.0};
  glm::dvec3 crown_P_mm{0.0};  ///< from the centre to that of the enamel; zero without enamel
  int fdi = 0;                 ///< 0: none
  int told_fdi = 0;            ///< a person gave it this number
  bool is_apart = false;       ///< a person said that it is a tooth of its own
  double low_z_P_mm = 0.0;     ///< its lowest voxel
};

/// Parts of at least 80 mm3, without numbers; by part.
std::vector<FoundTooth> measuredTeeth(const Mandible& jaw, const ToothRegions& regions, const GreyLevels& levels);

/// Sets the numbers, those that a person gave first of all; sorts from the right to the left along the arch.
void numberTeeth(const JawArch& arch, std::vector<FoundTooth>& teeth);

/// Whether the regions have changed: the teeth are to be measured and numbered again.
bool joinSpareParts(const Mandible& jaw, const std::vector<FoundTooth>& teeth, ToothRegions& regions);

}  // namespace assets
