// The models of a MeshScene in Embree: what shares pose and visibility is a body, a scene of its own with an instance
// in one of five upper scenes, by how it is seen. Frame P, mm. As MeshScene: set and place on one thread, then any may
// read.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "assets/mesh.h"
#include "render/cpu/mesh_scene.h"

// Embree's, whose own header stays in .cpp files.
struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;

namespace render {

struct MeshBodyPart {
  std::vector<glm::vec4> normals, colours;  ///< of the corners; no colours: white
  std::vector<glm::uvec3> triangles;
  assets::Material material;
  bool is_cut = false;
};

/// Parts that move alike and are seen alike.
struct MeshBody {
  Model model = Model::face;
  bool is_bur = false, transparent = false;
  bool is_held = false;             ///< its pose is not the identity
  glm::vec3 low{0.0f}, high{0.0f};  ///< its box, in its own frame
  std::vector<MeshBodyPart> parts;
  RTCSceneTy* scene = nullptr;  ///< null: the place is free
  RTCGeometryTy* instance = nullptr;
  RTCSceneTy* attached_to = nullptr;  ///< the upper scene that holds the instance now
  bool occluders = false;             ///< … and `occluders` too
  glm::mat3 P_from_mesh{1.0f};
  glm::mat4x3 pose{1.0f};
};

/// What a geometry tells those who are asked whether a ray meets it, by its user data.
enum class MeshTrait : std::uintptr_t { plain = 0, cuttable = 1, outside_only = 2 };

class MeshBodies {
 public:
  /// Throws GpuError if Embree can not be had.
  MeshBodies();
  ~MeshBodies();
  MeshBodies(const MeshBodies&) = delete;
  MeshBodies& operator=(const MeshBodies&) = delete;

  void setModel(Model model, const assets::MeshModel& mesh);
  void place(const Placements& placements, const FaceWindow& window);

  /// By their numbers in the upper scenes; some places may be free.
  const std::vector<MeshBody>& all() const { return bodies_; }
  float opacityOf(Model model) const { return placements_[model].opacity; }
  const FaceWindow& window() const { return window_; }
  std::uint64_t staticRevision() const { return static_revision_; }

  RTCSceneTy* still() const { return static_; }
  RTCSceneTy* moving() const { return dynamic_; }
  RTCSceneTy* transparent() const { return transparent_; }
  RTCSceneTy* through() const { return overlay_; }
  /// Once more what hides the guides that are seen through bone, while there are any.
  RTCSceneTy* occluders() const { return occluders_; }
  bool hasStatic() const { return has_static_; }
  bool hasDynamic() const { return has_dynamic_; }
  bool hasTransparent() const { return has_transparent_; }
  bool hasOverlay() const { return has_overlay_; }

 private:
  void remove(std::size_t index);
  RTCSceneTy* sceneOf(const std::vector<const assets::MeshPart*>& from, MeshBody& body);
  void show(std::size_t index, RTCSceneTy* in);
  void cover(std::size_t index, bool covers_guides);
  void move(MeshBody& body, const glm::dmat4& P_from_mesh);
  void throwIfFailed() const;

  RTCDeviceTy* device_;
  RTCSceneTy *static_ = nullptr, *dynamic_ = nullptr, *transparent_ = nullptr, *overlay_ = nullptr,
             *occluders_ = nullptr;
  std::vector<MeshBody> bodies_;
  Placements placements_ = placementsIn(Frame{});
  FaceWindow window_;
  bool has_static_ = false, has_dynamic_ = false, has_transparent_ = false, has_overlay_ = false;
  std::uint64_t static_revision_ = 0;
};

}  // namespace render
