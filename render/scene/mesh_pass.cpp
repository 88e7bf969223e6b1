#include "render/scene/mesh_pass.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

Triangles uploaded(const assets::MeshPart& part) {
  std::vector<MeshVertex> vertices(part.position_mm.size());
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertices[v] = {.position_mm = part.position_mm[v],
                   .normal = v < part.normal.size() ? part.normal[v] : glm::vec3(0.0f, 0.0f, 1.0f),
                   .colour = v < part.colour.size() ? part.colour[v] : glm::vec4(1.0f)};
  return {vertices, part.triangles};
}

}  // namespace

SceneMesh::SceneMesh(const assets::MeshModel& mesh, Model model) {
  for (const assets::MeshPart& part : mesh.parts)
    if (!part.triangles.empty())
      parts_.push_back({.triangles = uploaded(part),
                        .material = part.material,
                        .finish = finishOf(model, part.name),
                        .is_bur = part.name == "Bur",
                        .is_cut = isCutByWindow(model, part),
                        .is_veil_when_faded = isVeilWhenFaded(model, part.material)});
}

bool MeshPass::hasTransparent(const SceneMesh& mesh, float opacity) {
  if (opacity <= 0.0f) return false;
  return std::ranges::any_of(
      mesh.parts_, [opacity](const SceneMesh::Part& part) { return part.material.base_colour.a * opacity < 1.0f; });
}

Program& MeshPass::programFor(bool transparent, bool is_piece) {
  if (transparent && !transparent_) transparent_ = Program{"mesh.vert", "mesh_transparent.frag"};
  if (is_piece && !piece_) piece_ = Program{"mesh.vert", "piece.frag"};
  return transparent ? *transparent_ : is_piece ? *piece_ : opaque_;
}

void MeshPass::draw(const SceneMesh& mesh, Parts parts, const Placement& placement, bool view_is_mirrored) {
  const bool transparent = parts == Parts::transparent;
  if (placement.opacity <= 0.0f || mesh.parts_.empty() || (transparent && !hasTransparent(mesh, placement.opacity)))
    return;
  apply({.depth_write = !transparent,
         .mirrored = view_is_mirrored,
         .write_colour = !transparent,
         .write_distance = !transparent});
  programFor(transparent, mesh.parts_.front().finish == Finish::piece).use();
  const glm::dmat4 rotated =
      placement.P_from_mesh * glm::rotate(glm::dmat4(1.0), placement.bur_angle_rad, glm::dvec3(0.0, 0.0, 1.0));
  for (const SceneMesh::Part& part : mesh.parts_) {
    glm::vec4 colour = part.material.base_colour;
    colour.a *= placement.opacity;
    if ((colour.a < 1.0f) != transparent) continue;
    const int traits =
        (part.is_cut ? PART_CUT_BY_WINDOW : 0) + (transparent && part.is_veil_when_faded ? PART_VEIL : 0);
    block_.set(PART_BLOCK, {.P_from_mesh = glm::mat4(part.is_bur ? rotated : placement.P_from_mesh),
                            .base_colour = colour,
                            .finish = {part.material.roughness, part.material.metallic, static_cast<float>(part.finish),
                                       static_cast<float>(traits)}});
    part.triangles.draw();
  }
}

}  // namespace render
