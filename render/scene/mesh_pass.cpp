#include "render/scene/mesh_pass.h"

#include <glm/gtc/matrix_transform.hpp>

#include "render/shaders/shared_numbers.glsl"

namespace render {
namespace {

Triangles onGpu(const assets::MeshPart& part) {
  std::vector<MeshVertex> vertices(part.position_mm.size());
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertices[v] = {.position_mm = part.position_mm[v],
                   .normal = v < part.normal.size() ? part.normal[v] : glm::vec3(0.0f, 0.0f, 1.0f),
                   .colour = v < part.colour.size() ? part.colour[v] : glm::vec4(1.0f)};
  return {vertices, part.triangles};
}

}  // namespace

SceneMesh::SceneMesh(const assets::MeshModel& model, Finish finish) : finish_(finish) {
  for (const assets::MeshPart& part : model.parts)
    if (!part.triangles.empty())
      parts_.push_back({.triangles = onGpu(part), .material = part.material, .turns = part.name == "Bur"});
}

MeshPass::MeshPass() : program_("mesh.vert", "mesh.frag") {}

void MeshPass::draw(const SceneMesh& mesh, Parts parts, const Placement& placement) {
  const bool transparent = parts == Parts::transparent;
  apply({.depth_test = true,
         .depth_write = !transparent,
         .blend = transparent ? Blend::over : Blend::none,
         .mirrored = placement.view_is_mirrored,
         .write_distance = !transparent});
  program_.use();
  const glm::dmat4 turned =
      placement.P_from_mesh * glm::rotate(glm::dmat4(1.0), placement.bur_angle_rad, glm::dvec3(0.0, 0.0, 1.0));
  for (const SceneMesh::Part& part : mesh.parts_) {
    if ((part.material.base_colour.a < 1.0f) != transparent) continue;
    const float is_cut = mesh.finish_ == Finish::skin && part.material.metallic < 0.5f ? 1.0f : 0.0f;
    block_.set(PART_BLOCK,
               {.P_from_mesh = glm::mat4(part.turns ? turned : placement.P_from_mesh),
                .base_colour = part.material.base_colour,
                .finish = {part.material.roughness, part.material.metallic, static_cast<float>(mesh.finish_), is_cut}});
    part.triangles.draw();
  }
}

}  // namespace render
