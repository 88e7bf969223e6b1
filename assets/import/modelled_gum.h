// Gum of a jaw that was found in a scan: cone-beam scans do not tell gum from cheek, lip and tongue that lie against
// it. A layer of usual thickness over the alveolar bone and over a tooth that has not come through, from below the
// attached gum up to the necks of the teeth, as far as there is soft tissue: where a scan shows air at the gum, air
// bounds it. In a scan without soft tissue (a dry jaw) the layer alone. A model, to be called so: neither its thickness
// nor its course is this patient's. Mucoperiosteum: 1.5 to 2 mm. Frame P, mm. Any thread but the servo; 1 s for 512^3.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

inline constexpr double kGumThickness_mm = 2.0;

/// Voxels of the scan; none without numbered teeth. `jaw_label`, `tooth`: of the lower jaw (jaw_segmentation.h).
std::vector<std::size_t> modelledGum(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                                     const std::vector<std::uint8_t>& jaw_label,
                                     const std::vector<std::uint8_t>& tooth);

}  // namespace assets
