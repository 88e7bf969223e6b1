#include "app/case/left_out_teeth.h"

#include <array>
#include <cstdint>
#include <vector>

#include "assets/mesh/bone_surface.h"
#include "assets/surface_smoothing.h"
#include "assets/tooth.h"
#include "assets/vertex_normals.h"

namespace app {
namespace {

constexpr int kSmoothingSteps = 4;
constexpr float kEnamelRoughness = 0.25F;

}  // namespace

assets::MeshPart leftOutTeeth(const assets::CtVolume& ct, const std::function<bool(int fdi)>& is_left_out) {
  if (ct.tooth.empty()) return {};
  std::array<bool, 256> is_out{};
  for (std::size_t fdi = 1; fdi < is_out.size(); ++fdi) is_out[fdi] = is_left_out(static_cast<int>(fdi));
  // The box of them.
  glm::ivec3 low = ct.grid.size, end(0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (is_out[ct.tooth[v]]) low = glm::min(low, ijk), end = glm::max(end, ijk + 1);
  });
  if (glm::any(glm::greaterThanEqual(low, end))) return {};
  const assets::VolumeGrid grid{end - low, ct.grid.spacing_mm, ct.grid.centre_P_mm(low)};
  std::vector<std::uint8_t> solid(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t n) {
    const std::size_t v = ct.grid.index(low + ijk);
    if (is_out[ct.tooth[v]]) solid[n] = ct.solid[v];
  });
  assets::MeshPart part = assets::BoneSurface(assets::SolidVoxels::inGridOrder(grid, solid)).mergedMesh("LeftOutTeeth");
  assets::takeOffLumps(part.position_mm, part.triangles, kSmoothingSteps);
  part.normal = assets::vertexNormals(part.position_mm, part.triangles);
  part.material.base_colour = {assets::kEnamelAlbedo, 1.0F};
  part.material.roughness = kEnamelRoughness;
  return part;
}

}  // namespace app
