// How fast tissue goes under a turning bur. Trivially copyable, part of a Command. The factors come from hardness, see
// assets::kTissues. Plain data; any thread.
#pragma once

#include <array>

#include "assets/tissue.h"

namespace haptics {

struct ErosionParameters {
  double removal_rate_per_s = 4.0;  ///< fraction of a fully covered voxel of reference tissue per second
  std::array<double, assets::kTissueCount> tissue_factor = [] {
    std::array<double, assets::kTissueCount> factor{};
    for (std::size_t i = 0; i < factor.size(); ++i) factor[i] = assets::kTissues[i].removal_factor;
    return factor;
  }();
};

}  // namespace haptics
