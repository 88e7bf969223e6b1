// Teeth of a lower jaw as regions: what is denser than halfway from cortical bone to dentine, closed and filled,
// divided at its necks (thick_parts.h), without parts that are only dense bone, and joined again where the neck is
// nearly as thick as the thinner part, or where one part has no enamel or is tiny, a root (region_graph.h). Any thread
// but the servo; 3 s of CPU for a whole jaw at 0.35 mm.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/segment/grey_levels.h"
#include "assets/segment/mandible.h"

namespace assets {

struct ToothRegions {
  CellBox box;                     ///< of the jaw's grid, around all teeth
  std::vector<std::uint8_t> part;  ///< in the box: number from 1, 0 outside
  int count = 0;

  friend bool operator==(const ToothRegions&, const ToothRegions&) = default;
};

/// By part, in the box; [0] is none's. Empty: it has no cells.
std::vector<CellBox> boxesOfParts(const ToothRegions& teeth);

/// More than 254 parts: the smallest are left out.
ToothRegions findToothRegions(const Mandible& jaw, const GreyLevels& levels);

}  // namespace assets
