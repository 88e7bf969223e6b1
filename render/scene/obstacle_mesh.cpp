#include "render/scene/obstacle_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "assets/mesh/bone_surface.h"

namespace render {
namespace {

constexpr int kAirAround = 2;     // voxels of air around
constexpr int kMostVoxels = 400;  // along an edge: what lies farther off is no obstacle of the same piece
constexpr glm::vec4 kAmber{1.0F, 0.64F, 0.0F, 1.0F};  // linear; the canal is orange

/// The mean by weights 1 2 1 along one axis; the border is air.
void blur(std::vector<std::uint16_t>& field, glm::ivec3 size, int axis) {
  const std::vector<std::uint16_t> before = field;
  glm::ivec3 step(0);
  step[axis] = 1;
  assets::forVoxels(step, size - step, [&](glm::ivec3 ijk) {
    const auto at = [&](glm::ivec3 where) { return int{before[assets::indexIn(size, where)]}; };
    field[assets::indexIn(size, ijk)] = static_cast<std::uint16_t>((at(ijk - step) + 2 * at(ijk) + at(ijk + step)) / 4);
  });
}

}  // namespace

assets::MeshModel obstacleMesh(const Obstacles& obstacles) {
  assets::MeshModel model;
  if (obstacles.middle_P_mm.empty() || !(obstacles.voxel_mm > 0.0)) return model;
  glm::vec3 low = obstacles.middle_P_mm.front(), high = low;
  for (const glm::vec3& p : obstacles.middle_P_mm) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  assets::VolumeGrid grid;
  grid.spacing_mm = obstacles.voxel_mm;
  grid.origin_P_mm = glm::dvec3(low) - kAirAround * obstacles.voxel_mm;
  grid.size = glm::min(glm::ivec3(glm::round(glm::dvec3(high - low) / obstacles.voxel_mm)) + 2 * kAirAround + 1,
                       glm::ivec3(kMostVoxels));

  std::vector<std::uint16_t> field(grid.voxelCount(), 0);
  for (const glm::vec3& p : obstacles.middle_P_mm)
    if (const glm::ivec3 ijk(glm::round(grid.indexFromPoint(p))); grid.contains(ijk)) field[grid.index(ijk)] = 255 * 16;
  for (int axis = 0; axis < 3; ++axis) blur(field, grid.size, axis);
  // Twice as much: the surface lies where a quarter is left.
  std::vector<std::uint8_t> solid(field.size());
  std::ranges::transform(field, solid.begin(),
                         [](std::uint16_t value) { return static_cast<std::uint8_t>(std::min(255, value / 8)); });
  assets::MeshPart part = assets::BoneSurface(assets::SolidVoxels::inGridOrder(grid, solid)).mergedMesh("Obstacles");
  part.material.base_colour = kAmber;
  if (!part.triangles.empty()) model.parts.push_back(std::move(part));
  return model;
}

}  // namespace render
