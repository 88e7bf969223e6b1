// Sections of a piece of tooth at which force may break it: a root, or a crown at its neck. Along the tooth's axis,
// kRootLevels of them, each part of the piece beyond a level towards the tips is one section. What breaks it is stress
// at the section's edge, as of a beam with an elliptic section:
//   sigma = F n / A + sqrt((M_u c_u / I_u)^2 + (M_v c_v / I_v)^2) = 60 MPa; enamel counts a third, pulp nothing.
// A round root of 3.5 mm breaks at 253 N mm. Twist about the axis and a notch are left out: roots are not cut
// (shareOfBreakingRoot in body/bridge_strength). Found on
// a worker: frame and mm of the grid; 20 to 60 ms a tooth; allocates. The same bytes and labels give the same sections.
// Source: reference/extraction 1.3; section modulus as in any handbook of strength of materials.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "haptics/body/bridge.h"
#include "haptics/body/split_plan.h"

namespace haptics {

inline constexpr int kRootLevels = 8;
inline constexpr std::size_t kMostRootSections = 16;

struct RootSection {
  Bridge section;  ///< its normal points to the tip
  double enamel_share = 0.0;
  double beyond_mm3 = 0.0;  ///< what comes off
  SplitPlan split;          ///< of the same
};

struct RootSections {
  std::vector<RootSection> sections;  ///< at most kMostRootSections
  std::vector<std::uint16_t> beyond;  ///< of each voxel: bit n where it lies beyond section n
};

/// Of the largest connected part. `label`: assets::Tissue in the order of the grid, or empty: all is dentine.
RootSections rootSections(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                          std::span<const std::uint8_t> label);

}  // namespace haptics
