#include "render/volume/piece_mesh.h"

namespace render {
namespace {

VoxelBox bricksAround(const VoxelBox& voxels, glm::ivec3 bricks) {
  const glm::ivec3 first = voxels.first / assets::kBrickVoxels;
  return grown({first, (voxels.first + voxels.extent - 1) / assets::kBrickVoxels + 1 - first}, 0, bricks);
}

// Out of the solid, by central differences of one voxel: surfaceNormal of ray_march.glsl.
glm::vec3 outwardNormal(const BorderedField<std::uint16_t>& smooth, const glm::vec3& index) {
  const auto at = [&](const glm::vec3& place) {
    return trilinear(smooth, glm::clamp(place, glm::vec3(-1.0f), glm::vec3(smooth.layout().size)));
  };
  glm::vec3 outward;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 step(0.0f);
    step[axis] = 1.0f;
    outward[axis] = at(index - step) - at(index + step);
  }
  return glm::length(outward) > 0.0f ? glm::normalize(outward) : glm::vec3(0.0f, 0.0f, 1.0f);
}

}  // namespace

PieceMesh::PieceMesh(const assets::VolumeGrid& grid_Q, std::span<const std::uint8_t> solid)
    : fields_(grid_Q, solid, {}), surface_(fields_.voxels()), normals_(assets::countIn(grid_Q.bricks())) {
  forEachIn({glm::ivec3(0), grid_Q.bricks()}, [this](glm::ivec3 brick) { updateNormals(brick); });
  model_.parts.resize(1);
  model_.parts.front().name = "Piece";
}

void PieceMesh::updateNormals(glm::ivec3 brick) {
  const std::size_t n = surface_.brickIndex(brick);
  const assets::SurfacePatch& patch = surface_.patch(brick);
  normals_[n].resize(patch.position_P_mm.size());
  for (std::size_t v = 0; v < normals_[n].size(); ++v)
    normals_[n][v] =
        outwardNormal(fields_.smooth(), glm::vec3(fields_.grid().indexFromPoint(glm::dvec3(patch.position_P_mm[v]))));
}

bool PieceMesh::prepare() {
  const FieldChanges& changes = fields_.prepare();
  if (changes.solid.empty() && !is_new_) return false;

  std::vector<glm::ivec3> changed;
  const glm::ivec3 bricks = fields_.grid().bricks();
  for (const VoxelBox& box : changes.solid)
    forEachIn(bricksAround(box, bricks), [&](glm::ivec3 brick) { changed.push_back(brick); });
  if (!changed.empty()) surface_.update(fields_.voxels(), changed);

  // A normal reads up to two voxels from its vertex, and a patch has vertices on the first voxels of the next brick.
  constexpr int kNormalReach = 3;
  for (const VoxelBox& box : changes.smooth)
    forEachIn(bricksAround(grown(box, kNormalReach, fields_.grid().size), bricks),
              [this](glm::ivec3 brick) { updateNormals(brick); });
  putTogether();
  is_new_ = false;
  return true;
}

// Patches share the places of vertices on their border, bit for bit, and so the normals.
void PieceMesh::putTogether() {
  assets::MeshPart& part = model_.parts.front();
  part.position_mm.clear(), part.normal.clear(), part.triangles.clear();
  forEachIn({glm::ivec3(0), fields_.grid().bricks()}, [&](glm::ivec3 brick) {
    const assets::SurfacePatch& patch = surface_.patch(brick);
    const std::vector<glm::vec3>& normals = normals_[surface_.brickIndex(brick)];
    const auto first = static_cast<std::uint32_t>(part.position_mm.size());
    part.position_mm.insert(part.position_mm.end(), patch.position_P_mm.begin(), patch.position_P_mm.end());
    part.normal.insert(part.normal.end(), normals.begin(), normals.end());
    for (const std::uint32_t vertex : patch.triangles) part.triangles.push_back(first + vertex);
  });
}

}  // namespace render
