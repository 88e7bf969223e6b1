// Bone and teeth as separate solid fields, for surfaces of either.
// Against air or soft tissue a body ends where the whole field ends. Between tooth and bone the labels decide,
// smoothed:
//   field = min(solid, 255 share), share = sum of w solid over the body's voxels / the same over all voxels,
// w binomial 1 4 6 4 1 along each axis (sigma one voxel); both bodies end there at one surface. Solid voxels without a
// hard label (partial voxels, ligament) weigh 1/50. Any thread; parallel (TBB), about 30 ns a voxel and core; 8 bytes a
// voxel. No segmentation.
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

/// Whether a label (assets::Tissue) belongs to that body; everything that is no tooth belongs to bone.
bool belongsTo(std::uint8_t label, HardTissue tissue);

/// `solid` and `label` in grid order; without labels everything is bone.
std::vector<std::uint8_t> solidOf(HardTissue tissue, const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                  std::span<const std::uint8_t> label);

}  // namespace assets
