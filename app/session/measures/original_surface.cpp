#include "app/session/measures/original_surface.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "haptics/body/distance_field.h"

namespace app {
namespace {

/// Voxels of up to this edge tell a normal that is taken over 2 mm: of a tooth's fine field a sixty-fourth is kept.
constexpr double kEdge_mm = 0.2;

struct CoarseSolid {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> bytes;
};

/// Means over blocks of voxels; at the far sides over what there is of them.
CoarseSolid coarsened(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, int edge_voxels) {
  assert(solid.size() == grid.voxelCount());
  CoarseSolid made;
  made.grid.size = (grid.size + (edge_voxels - 1)) / edge_voxels;
  made.grid.spacing_mm = edge_voxels * grid.spacing_mm;
  made.grid.origin_P_mm = grid.origin_P_mm + 0.5 * (edge_voxels - 1) * grid.spacing_mm;
  std::vector<std::uint32_t> sum(made.grid.voxelCount(), 0), count(made.grid.voxelCount(), 0);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::size_t block = made.grid.index(ijk / edge_voxels);
    sum[block] += solid[v];
    ++count[block];
  });
  made.bytes.resize(sum.size());
  for (std::size_t block = 0; block < sum.size(); ++block)
    made.bytes[block] = static_cast<std::uint8_t>((sum[block] + count[block] / 2) / count[block]);
  return made;
}

}  // namespace

OriginalSurface::OriginalSurface(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid) : grid_(grid) {
  const int edge_voxels = std::max(1, static_cast<int>(kEdge_mm / grid.spacing_mm + 1e-9));
  if (edge_voxels == 1) {
    field_ = std::make_unique<haptics::DistanceField>(grid, solid, kBand_mm);
    return;
  }
  const CoarseSolid coarse = coarsened(grid, solid, edge_voxels);
  field_ = std::make_unique<haptics::DistanceField>(coarse.grid, coarse.bytes, kBand_mm);
}
OriginalSurface::~OriginalSurface() = default;

double OriginalSurface::distance_mm(const glm::dvec3& p_P_mm) const { return field_->at_mm(p_P_mm); }

glm::dvec3 OriginalSurface::normalAt(const glm::dvec3& p_P_mm) const {
  const glm::dvec3 index = grid_.indexFromPoint(p_P_mm);
  if (!(glm::all(glm::greaterThanEqual(index, glm::dvec3(0.0))) &&
        glm::all(glm::lessThanEqual(index, glm::dvec3(grid_.size - 1)))))
    return glm::dvec3(0.0);
  // Over a millimetre to either side: the surface's direction, not a voxel's.
  constexpr double kReach_mm = 1.0;
  glm::dvec3 gradient(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0.0);
    step[axis] = kReach_mm;
    gradient[axis] = field_->at_mm(p_P_mm + step) - field_->at_mm(p_P_mm - step);
  }
  const double length = glm::length(gradient);
  return length > 0.2 * kReach_mm ? gradient / length : glm::dvec3(0.0);
}

}  // namespace app
