// Bone and teeth as solid fields of their own, cut out of one: what a surface of either is made from.
// Where a body borders on air or soft tissue it ends where the whole ends: its field is the whole's. Where tooth meets
// bone the border is drawn by the labels, smoothed: a voxel belongs to a body by its share of the hard matter around,
//   field = min(solid, 255 share), share = sum of w solid over the body's voxels / the same over all,
// w binomial 1 4 6 4 1 along each axis (sigma one voxel), so that no voxel shows as a step; both bodies end there at
// one surface. Solid without a hard tissue's label (partial voxels at a surface, ligament) counts a fiftieth: it goes
// with its side. Any thread; parallel inside (TBB), about 30 ns a voxel and core; allocates 8 bytes a voxel. Not a
// segmentation.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

enum class HardTissue { bone, tooth };

/// "Bone", "Teeth".
std::string_view nameOf(HardTissue tissue);

/// Whether a label (assets::Tissue) counts as that body.
bool belongsTo(std::uint8_t label, HardTissue tissue);

/// `solid` and `label` in the order of the grid; an empty label means that all is bone.
std::vector<std::uint8_t> solidOf(HardTissue tissue, const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                  std::span<const std::uint8_t> label);

}  // namespace assets
