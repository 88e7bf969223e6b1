// Triangle meshes: a model is a list of named parts, each with one material.
// mm; the owner defines the frame (face and gingiva: P; instruments: T). Unit normals; counter-clockwise seen from
// outside. Plain data; any thread. Drawn only: the bur never cuts a mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

struct Material {
  glm::vec4 base_colour{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGB and opacity
  float roughness = 0.6f;                         ///< GGX, 0..1
  float metallic = 0.0f;
};

struct MeshPart {
  std::string name;
  Material material;
  std::vector<glm::vec3> position_mm;
  std::vector<glm::vec3> normal;         ///< one per position
  std::vector<glm::vec4> colour;         ///< linear RGBA factor per position, or empty for white
  std::vector<std::uint32_t> triangles;  ///< three indices each
};

struct MeshModel {
  std::vector<MeshPart> parts;
};

}  // namespace assets
