// A piece's volume divided in two: the bytes that come off; what stays is the difference, so no solid is lost or made.
// Frame and mm of the grid. Any thread; O(voxels of the grid), 10-50 ms for a tooth; allocates. The same bytes of solid
// give the same plan, so that a replay can recompute it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/ct_volume.h"
#include "haptics/body/bridge.h"
#include "haptics/body/components.h"
#include "haptics/body/split_plan.h"

namespace haptics {

/// Whether a voxel that is less than half solid goes with what is chosen: as the most solid of its six neighbours of at
/// least half, else of the twelve at its edges, else of the eight at its corners. is_chosen(ijk) is asked of those.
template <class IsChosen>
bool followsChosen(const Components& components, glm::ivec3 ijk, const IsChosen& is_chosen) {
  std::uint8_t most = 0;
  bool goes = false;
  for (int reach = 1; reach <= 3 && most < assets::kHalfSolid; ++reach)
    assets::forVoxels(ijk - 1, ijk + 2, [&](glm::ivec3 beside) {
      const glm::ivec3 away = glm::abs(beside - ijk);
      const std::uint8_t solid = components.solidAt(beside);
      if (away.x + away.y + away.z != reach || solid < assets::kHalfSolid || solid <= most) return;
      most = solid;
      goes = is_chosen(beside);
    });
  return goes;
}

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
