#include "assets/scan/label_distance.h"

#include <array>
#include <cassert>
#include <map>

#include "assets/scan/exact_distance.h"

namespace assets {
namespace {

/// From `low` to before `end`; may reach beyond the volume.
struct VoxelBox {
  glm::ivec3 low{0}, end{0};

  glm::ivec3 size() const { return glm::max(end - low, 0); }
};

VoxelBox boxOf(const VolumeGrid& grid, std::span<const std::uint8_t> belongs) {
  VoxelBox box{grid.size, glm::ivec3(0)};
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (belongs[v] == 0) return;
    box.low = glm::min(box.low, ijk);
    box.end = glm::max(box.end, ijk + 1);
  });
  return box;
}

/// The largest part of the box around a voxel that is small enough.
VoxelBox shrunk(const VoxelBox& box, glm::ivec3 around, std::size_t most_voxels) {
  VoxelBox part = box;
  for (int reach = glm::max(box.size().x, glm::max(box.size().y, box.size().z)); countIn(part.size()) > most_voxels;
       reach -= 4) {
    const glm::ivec3 middle = glm::clamp(around, box.low, box.end - 1);
    part = {glm::max(box.low, middle - reach), glm::min(box.end, middle + reach + 1)};
  }
  return part;
}

/// Of every voxel of the box outside (`outside`) or inside the structure to the centre of the nearest one that is not;
/// not positive elsewhere. Order of the box.
std::vector<float> boxDistances_mm(const VolumeGrid& grid, std::span<const std::uint8_t> belongs, const VoxelBox& box,
                                   bool outside) {
  std::vector<std::uint8_t> is_chosen;
  is_chosen.reserve(countIn(box.size()));
  forVoxels(box.low, box.end, [&](glm::ivec3 ijk) {
    const bool is_inside = grid.contains(ijk) && belongs[grid.index(ijk)] != 0;
    is_chosen.push_back(is_inside == outside ? 1 : 0);
  });
  return exactDistance_mm(box.size(), grid.spacing_mm, is_chosen);
}

bool isAtSurface(const VolumeGrid& grid, std::span<const std::uint8_t> belongs, glm::ivec3 ijk) {
  constexpr std::array<glm::ivec3, 6> kBeside{glm::ivec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                                              {0, -1, 0},          {0, 0, 1},  {0, 0, -1}};
  return std::ranges::any_of(
      kBeside, [&](glm::ivec3 way) { return !grid.contains(ijk + way) || belongs[grid.index(ijk + way)] == 0; });
}

using Cluster = StructureDistance::Cluster;

/// `middle(n)` and `radius(n)` of the parts from `first` to before `end`.
template <class Middle, class Radius>
Cluster clusterOf(std::size_t first, std::size_t end, const Middle& middle, const Radius& radius) {
  glm::vec3 low = middle(first), high = low;
  for (std::size_t n = first; n < end; ++n) low = glm::min(low, middle(n)), high = glm::max(high, middle(n));
  Cluster cluster{0.5F * (low + high), 0.0F, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)};
  for (std::size_t n = first; n < end; ++n)
    cluster.radius_mm = std::max(cluster.radius_mm, glm::distance(cluster.middle_P_mm, middle(n)) + radius(n));
  return cluster;
}

/// Voxels by cubes of `kBrickVoxels`, those by cubes of four times their edge.
void addSurface(const VolumeGrid& grid, std::span<const std::uint8_t> belongs, const VoxelBox& box,
                StructureDistance& structure) {
  using Brick = std::array<int, 3>;
  std::map<Brick, std::map<Brick, std::vector<glm::vec3>>> by_group;
  forVoxels(box.low, box.end, [&](glm::ivec3 ijk) {
    if (belongs[grid.index(ijk)] == 0 || !isAtSurface(grid, belongs, ijk)) return;
    const glm::ivec3 brick = ijk / kBrickVoxels, group = brick / 4;
    by_group[{group.z, group.y, group.x}][{brick.z, brick.y, brick.x}].emplace_back(grid.centre_P_mm(ijk));
  });
  for (const auto& [group, bricks] : by_group) {
    const std::size_t first_cluster = structure.clusters.size();
    for (const auto& [brick, points] : bricks) {
      const std::size_t first = structure.surface_P_mm.size();
      structure.surface_P_mm.insert(structure.surface_P_mm.end(), points.begin(), points.end());
      structure.clusters.push_back(clusterOf(
          first, structure.surface_P_mm.size(), [&](std::size_t n) { return structure.surface_P_mm[n]; },
          [](std::size_t) { return 0.0F; }));
    }
    structure.groups.push_back(clusterOf(
        first_cluster, structure.clusters.size(), [&](std::size_t n) { return structure.clusters[n].middle_P_mm; },
        [&](std::size_t n) { return structure.clusters[n].radius_mm; }));
  }
}

}  // namespace

StructureDistance structureDistance(const VolumeGrid& grid, std::span<const std::uint8_t> belongs,
                                    const glm::dvec3& near_P_mm, std::size_t most_voxels) {
  assert(belongs.size() == grid.voxelCount());
  StructureDistance structure;
  structure.grid = {glm::ivec3(0), grid.spacing_mm, grid.origin_P_mm};
  const VoxelBox body = boxOf(grid, belongs);
  if (body.size().x == 0) return structure;
  addSurface(grid, belongs, body, structure);

  // One voxel more, so that the reach lies within the box.
  const int reach = static_cast<int>(std::ceil(StructureDistance::kReach_mm / grid.spacing_mm)) + 1;
  const VoxelBox whole{body.low - reach, body.end + reach};
  const VoxelBox box = shrunk(whole, glm::ivec3(glm::round(grid.indexFromPoint(near_P_mm))), most_voxels);
  structure.grid.size = box.size();
  structure.grid.origin_P_mm = grid.centre_P_mm(box.low);
  const std::vector<float> outside_mm = boxDistances_mm(grid, belongs, box, true);
  const std::vector<float> inside_mm = boxDistances_mm(grid, belongs, box, false);
  structure.distance.resize(outside_mm.size());
  forVoxels(structure.grid, [&](glm::ivec3 ijk, std::size_t v) {
    // What lies behind a side where the structure was cut off may be nearer.
    int known = std::numeric_limits<int>::max();
    for (int axis = 0; axis < 3; ++axis) {
      if (box.low[axis] > whole.low[axis]) known = std::min(known, ijk[axis]);
      if (box.end[axis] < whole.end[axis]) known = std::min(known, box.size()[axis] - 1 - ijk[axis]);
    }
    // The centres inside lie 0.4 voxels from the surface, those outside 0.6.
    const bool is_outside = outside_mm[v] > 0.0F;
    const double to_other_mm = static_cast<double>(is_outside ? outside_mm[v] : inside_mm[v]);
    const double surface_mm = StructureDistance::kSurface_voxels * grid.spacing_mm;
    const double mm = is_outside ? to_other_mm - surface_mm : grid.spacing_mm - surface_mm - to_other_mm;
    const bool is_known = to_other_mm <= static_cast<double>(known) * grid.spacing_mm;
    structure.distance[v] = mm >= StructureDistance::kReach_mm || !is_known
                                ? StructureDistance::kFar
                                : static_cast<std::int16_t>(std::lround(StructureDistance::kPerMm *
                                                                        std::max(mm, -StructureDistance::kDepth_mm)));
  });
  return structure;
}

}  // namespace assets
