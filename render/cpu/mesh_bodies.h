// The models of a MeshScene in Embree. Parts that share pose and visibility form a body: a scene of its own, with an
// instance in the top-level scene of its group. Frame P, mm. Threads as MeshScene.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "assets/mesh.h"
#include "render/scene/models.h"
#include "render/soft_block.h"

// Embree's, whose own header stays in .cpp files.
struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;

namespace render {

/// The hole in the face around the line from the eyes to the site.
struct FaceWindow {
  glm::vec3 eye_P{0.0f}, site_P{0.0f};
  float radius_mm = 0.0f;  ///< 0: none
  bool operator==(const FaceWindow&) const = default;
};

/// The top-level scenes. `veil`: the faded face; `overlay`: guides seen through bone; `occluders`: copies of what hides
/// these.
enum class MeshGroup { fixed, moving, veil, transparent, overlay, occluders };
inline constexpr std::size_t kMeshGroups = 6;

struct MeshBodyPart {
  std::vector<glm::vec4> normals, colours;  ///< per vertex; no colours: white
  std::vector<glm::uvec3> triangles;
  assets::Material material;
  Finish finish = Finish::skin;
  bool is_cut = false;  ///< by the face window
};

/// Parts with the same pose and visibility.
struct MeshBody {
  Model model = Model::face;
  bool is_bur = false, transparent = false;
  bool has_pose = false;            ///< its pose is not the identity
  glm::vec3 low{0.0f}, high{0.0f};  ///< bounding box, in its own frame
  std::vector<MeshBodyPart> parts;
  RTCSceneTy* scene = nullptr;  ///< null: the slot is free
  RTCGeometryTy* instance = nullptr;
  std::optional<MeshGroup> group;  ///< holds the instance now
  bool is_occluder = false;        ///< `occluders` holds it too
  glm::mat3 P_from_mesh{1.0f};
  glm::mat4x3 pose{1.0f};
};

/// User data of a geometry, for the intersection filter. `torn`: where a bur cut it, it is gone.
enum class MeshTrait : std::uintptr_t { plain = 0, cuttable = 1, outside_only = 2, torn = 3 };

class MeshBodies {
 public:
  /// Throws GpuError if Embree is not available.
  MeshBodies();
  ~MeshBodies();
  MeshBodies(const MeshBodies&) = delete;
  MeshBodies& operator=(const MeshBodies&) = delete;

  /// An empty model removes the previous one. The instrument's part "Bur" rotates about its z axis.
  void setModel(Model model, const assets::MeshModel& mesh);
  /// Initially as for a default Frame. Of the marks the cuts count; a new cut is a change of the fixed meshes.
  void place(const Placements& placements, const FaceWindow& window = {}, const SoftBlock& soft = {});

  /// By instance ID; some slots may be free.
  const std::vector<MeshBody>& all() const { return bodies_; }
  float opacityOf(Model model) const { return placements_[model].opacity; }
  bool hasGuides() const {
    return opacityOf(Model::mandibular_canal) > 0.0f || opacityOf(Model::ruler) > 0.0f ||
           opacityOf(Model::arrow) > 0.0f;
  }
  const FaceWindow& window() const { return window_; }
  const SoftBlock& soft() const { return soft_; }
  std::uint64_t staticRevision() const { return static_revision_; }

  RTCSceneTy* scene(MeshGroup group) const { return scenes_[static_cast<std::size_t>(group)]; }
  /// Whether the group has visible bodies; not for `occluders`.
  bool has(MeshGroup group) const { return has_[static_cast<std::size_t>(group)]; }

 private:
  void remove(std::size_t index);
  RTCSceneTy* sceneOf(const std::vector<const assets::MeshPart*>& from, MeshBody& body);
  void attach(std::size_t index, std::optional<MeshGroup> group);
  void setOccluder(std::size_t index, bool is_occluder);
  void move(MeshBody& body, const glm::dmat4& P_from_mesh);
  void throwIfFailed() const;

  RTCDeviceTy* device_;
  std::array<RTCSceneTy*, kMeshGroups> scenes_{};
  std::array<bool, kMeshGroups> has_{};
  std::vector<MeshBody> bodies_;
  Placements placements_ = placementsIn(Frame{});
  FaceWindow window_;
  SoftBlock soft_;
  std::uint64_t static_revision_ = 0;
};

}  // namespace render
