// A piece's volume divided in two: the bytes that come off; what stays is the difference, so no solid is lost or made.
// Frame and mm of the grid. Any thread; O(voxels of the grid), 10-50 ms for a tooth; allocates. The same bytes of solid
// give the same plan, so that a replay can recompute it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "haptics/body/bridge.h"
#include "haptics/body/components.h"
#include "haptics/body/split_plan.h"

namespace haptics {

/// Of the voxels that are chosen (not 0), in the order of the grid: whole, with what is partly solid next to them. A
/// voxel that is less than half solid goes with the most solid of its six neighbours, else of its 26.
std::vector<std::uint8_t> bytesOf(const Components& components, std::span<const std::uint8_t> chosen);

/// Of a connected piece, alike.
std::vector<std::uint8_t> bytesOfPiece(const Components& components, std::size_t piece);

/// `bytes` as of the functions above.
SplitPlan splitPlan(const assets::VolumeGrid& grid, std::span<const std::uint8_t> bytes);

/// Of a piece that has fallen apart: its next largest component comes off; chips stay with the largest. Nothing: it is
/// in one piece of kLeastPiece_mm3 and more.
SplitPlan partingPlan(const Components& components);

}  // namespace haptics
