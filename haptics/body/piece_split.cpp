#include "haptics/body/piece_split.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "assets/ct_volume.h"
#include "haptics/bone/solid_field.h"

namespace haptics {
std::vector<std::uint8_t> bytesOf(const Components& components, std::span<const std::uint8_t> chosen) {
  const assets::VolumeGrid& grid = components.grid();
  assert(chosen.size() == grid.voxelCount());
  std::vector<std::uint8_t> bytes(grid.voxelCount(), 0);
  const auto is_chosen = [&](glm::ivec3 ijk) { return chosen[grid.index(ijk)] != 0; };
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::uint8_t solid = components.solidAt(ijk);
    if (solid == 0) return;
    if (solid >= assets::kHalfSolid ? chosen[v] != 0 : followsChosen(components, ijk, is_chosen)) bytes[v] = solid;
  });
  return bytes;
}

std::vector<std::uint8_t> bytesOfPiece(const Components& components, std::size_t piece) {
  std::vector<std::uint8_t> chosen(components.grid().voxelCount());
  assets::forVoxels(components.grid(), [&](glm::ivec3 ijk, std::size_t v) {
    chosen[v] = components.pieceAt(ijk) == static_cast<int>(piece) ? 1 : 0;
  });
  return bytesOf(components, chosen);
}

SplitPlan splitPlan(const assets::VolumeGrid& grid, std::span<const std::uint8_t> bytes) {
  SolidField lattice;
  lattice.blocks = (grid.size + kBlockEdge - 1) / kBlockEdge;
  std::map<std::size_t, SplitPlan::Block> blocks;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (bytes[v] == 0) return;
    const std::size_t block = lattice.blockAt(SolidField::blockOf(ijk));
    SplitPlan::Block& planned = blocks[block];
    planned.block = static_cast<std::uint32_t>(block);
    planned.given[SolidField::within(ijk)] = bytes[v];
  });
  SplitPlan plan;
  for (const auto& [number, block] : blocks) plan.blocks.push_back(block);
  return plan;
}

SplitPlan partingPlan(const Components& components) {
  const std::span<const ToothPiece> pieces = components.pieces();
  if (pieces.size() < 2 || pieces[1].volume_mm3 < kLeastPiece_mm3) return {};
  return splitPlan(components.grid(), bytesOfPiece(components, 1));
}

}  // namespace haptics
