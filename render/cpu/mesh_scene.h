// Face, gum and instruments for rays on the CPU: a scene of two levels in Embree, the models below, above them their
// instances - what a hand holds moved with each frame, the bur turning besides. Frame P, mm.
// Opaque parts are met first hit by first hit; transparent ones are all met along a ray, and come back to front. The
// window in the face opens it as shaders/mesh.frag does. Both sides of a triangle are met, in mirrored views too.
// Setting a model builds its tree (20 ms for 35,000 triangles); placing costs some microseconds. setModel and place on
// one thread, then any number of threads may trace. A ray costs about 30 ns.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "assets/mesh.h"
#include "render/cpu/mesh_points.h"

namespace render {

/// Where the models are in this frame, and how much of them is seen.
struct MeshPlacement {
  glm::dmat4 P_from_tool{1.0};
  double bur_angle_rad = 0.0;
  bool tool_visible = true, gum_visible = true;
  glm::dmat4 P_from_second{1.0};
  bool second_visible = false;
  float face_opacity = 1.0f;  ///< 0: no face
  bool mandibular_canal_visible = false;
  glm::dmat4 P_from_hand{1.0};  ///< of the ghost
  float ghost_opacity = 0.0f;
  float mandibular_canal_through_opacity = 0.0f;
  glm::vec3 window_eye_P{0.0f}, window_site_P{0.0f};
  float window_mm = 0.0f;  ///< 0: the face is whole
};

class MeshScene {
 public:
  /// `canal` where it lies open and, `_through`, through bone and gum; `ghost`: the instrument at the hand, likewise.
  enum class Model { face, gum, instrument, second_instrument, mandibular_canal, mandibular_canal_through, ghost };

  /// Throws GpuError if Embree can not be had.
  MeshScene();
  ~MeshScene();

  /// An empty model removes what was there. The instrument's part "Bur" turns about its z axis.
  void setModel(Model model, const assets::MeshModel& mesh);
  void place(const MeshPlacement& placement);

  bool hasTransparent() const;

  /// The first opaque place along every ray, 0 mm where there is none, in two halves: face and gum, which stay what
  /// they are for the same rays until stillRevision() changes; then the instruments, where they lie before them.
  void stillHits(const RayBatch& rays, MeshHits& hits) const;
  void addMovingHits(const RayBatch& rays, MeshHits& hits) const;
  std::uint64_t stillRevision() const;
  /// Adds those hits that are what the ray sees: nothing at `seen_mm[i]` before them.
  void addSeen(const RayBatch& rays, const MeshHits& hits, const float* seen_mm, MeshPoints& to) const;
  /// Every transparent place before `limit_mm[i]`, and of what is seen through bone and gum all that lies before the
  /// opaque face and instruments; ray by ray, each ray's from back to front.
  void layers(const RayBatch& rays, const float* limit_mm, MeshPoints& to) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
