// Draws triangle meshes: face, gingiva, instruments. Each draw has a rigid pose into frame P. Render thread.
// Opaque parts write depth and distance and come before the volume; transparent parts come after it, into
// FragmentLists. Parts of the face, except metal (a retractor), are cut away around the line from the eyes to the site
// (EyeBlock).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "assets/mesh.h"
#include "render/gpu/drawing.h"
#include "render/gpu/program.h"
#include "render/scene/models.h"

namespace render {

/// std140 twin of part_block.glsl.
struct PartBlock {
  glm::mat4 P_from_mesh{1.0f};
  glm::vec4 base_colour{1.0f};
  glm::vec4 finish{0.0f};
};
static_assert(sizeof(PartBlock) == 96);

/// A model on the GPU. A part named "Bur" rotates about the mesh's z axis.
class SceneMesh {
 public:
  SceneMesh() = default;
  SceneMesh(const assets::MeshModel& mesh, Model model);

 private:
  friend class MeshPass;
  struct Part {
    Triangles triangles;
    assets::Material material;
    Finish finish = Finish::skin;
    bool is_bur = false;
    bool is_cut = false;              ///< by the face window
    bool is_veil_when_faded = false;  ///< only the nearest surface counts
  };
  std::vector<Part> parts_;
};

class MeshPass {
 public:
  enum class Parts { opaque, transparent };

  void draw(const SceneMesh& mesh, Parts parts, const Placement& placement, bool view_is_mirrored);
  /// Whether draw() with Parts::transparent has anything to draw.
  static bool hasTransparent(const SceneMesh& mesh, float opacity);

 private:
  Program& programFor(bool transparent, bool is_piece);

  Program opaque_{"mesh.vert", "mesh.frag"};
  std::optional<Program> transparent_, piece_;
  UniformBlock<PartBlock> block_;
};

}  // namespace render
