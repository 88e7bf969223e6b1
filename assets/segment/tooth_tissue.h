// Enamel, dentine and pulp of teeth by grey value: enamel above halfway from dentine to the tooth's brightest, pulp
// below half of dentine and inside. A voxel of the surface is divided between tooth and surroundings, so it takes the
// tissue of the nearest voxel behind it. The rest of the jaw is cortical or trabecular bone. Any thread but the servo;
// parallel over teeth; 1 s of CPU for a whole jaw at 0.35 mm, less for teeth that are known.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/segment/known_parts.h"
#include "assets/segment/tooth_regions.h"

namespace assets {

class ToothTissues {
 public:
  /// Of one jaw: tissue values in the box of `teeth`; 0 outside them. The same whatever was asked before.
  std::vector<std::uint8_t> of(const Mandible& jaw, const ToothRegions& teeth, const GreyLevels& levels);

 private:
  KnownParts<std::vector<std::uint8_t>> known_;  ///< by its cells
};

}  // namespace assets
