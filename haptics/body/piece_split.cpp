#include "haptics/body/piece_split.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "assets/ct_volume.h"
#include "haptics/bone/solid_field.h"

namespace haptics {
namespace {

/// is_first(voxel of at least half) decides; what is less solid follows its neighbours.
template <class IsFirst>
std::vector<std::uint8_t> bytesWhere(const Components& components, const IsFirst& is_first) {
  const assets::VolumeGrid& grid = components.grid();
  std::vector<std::uint8_t> bytes(grid.voxelCount(), 0);
  const auto follows = [&](glm::ivec3 ijk) {
    std::uint8_t most = 0;
    bool first = false;
    for (int reach = 1; reach <= 3 && most < assets::kHalfSolid; ++reach)
      assets::forVoxels(ijk - 1, ijk + 2, [&](glm::ivec3 beside) {
        const glm::ivec3 away = glm::abs(beside - ijk);
        const std::uint8_t solid = components.solidAt(beside);
        if (away.x + away.y + away.z != reach || solid < assets::kHalfSolid || solid <= most) return;
        most = solid;
        first = is_first(beside);
      });
    return first;
  };
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::uint8_t solid = components.solidAt(ijk);
    if (solid == 0) return;
    if (solid >= assets::kHalfSolid ? is_first(ijk) : follows(ijk)) bytes[v] = solid;
  });
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> bytesOfPiece(const Components& components, std::size_t piece) {
  return bytesWhere(components, [&](glm::ivec3 ijk) { return components.pieceAt(ijk) == static_cast<int>(piece); });
}

std::vector<std::uint8_t> bytesBeforeBreak(const Components& components, const BridgeSearch& search,
                                           std::size_t bridge) {
  std::vector<std::uint8_t> bytes =
      bytesWhere(components, [&](glm::ivec3 ijk) { return search.isOnFirstSide(bridge, ijk); });

  const assets::VolumeGrid& grid = components.grid();
  const Bridge& broken = search.bridges()[bridge];
  const glm::dvec3 n = glm::abs(broken.normal);
  const double across_mm = grid.spacing_mm * (n.x + n.y + n.z);
  const auto share = [&](glm::ivec3 ijk) {
    const double beyond_mm = glm::dot(grid.centre_P_mm(ijk) - broken.centre_mm, broken.normal);
    if (std::abs(beyond_mm) > grid.spacing_mm) return;
    const double first = std::clamp(0.5 - beyond_mm / across_mm, 0.0, 1.0);
    bytes[grid.index(ijk)] = static_cast<std::uint8_t>(std::lround(components.solidAt(ijk) * first));
  };
  for (const BridgeSearch::CutFace& face : search.facesOf(bridge)) {
    share(face.first);
    share(face.second);
  }
  return bytes;
}

SplitPlan splitPlan(const assets::VolumeGrid& grid, std::span<const std::uint8_t> bytes) {
  SolidField lattice;
  lattice.blocks = (grid.size + kBlockEdge - 1) / kBlockEdge;
  std::map<std::size_t, SplitPlan::Block> blocks;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (bytes[v] == 0) return;
    const std::size_t at = lattice.offsetOf(ijk), block = at / kBlockVoxels;
    SplitPlan::Block& planned = blocks[block];
    planned.block = static_cast<std::uint32_t>(block);
    planned.given[at % kBlockVoxels] = bytes[v];
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
