// Face, gingiva and instruments for rays on the CPU: a scene of two levels in Embree, the models below, above them
// their instances - what a hand holds moved with each frame, the bur turning besides. Frame P, mm. Opaque parts are met
// first hit by first hit; transparent ones are all met along a ray, and come back to front. The window in the face
// opens it as shaders/mesh.frag does. Both sides of a triangle are met, in mirrored views too. Setting a model builds
// its tree (20 ms for 35,000 triangles); placing costs some microseconds. setModel and place on one thread, then any
// number of threads may trace. A ray costs about 30 ns.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "assets/mesh.h"
#include "render/cpu/mesh_points.h"
#include "render/scene/models.h"

namespace render {

/// The hole in the face, around the line from the eyes to the site.
struct FaceWindow {
  glm::vec3 eye_P{0.0f}, site_P{0.0f};
  float radius_mm = 0.0f;  ///< 0: the face is whole
  bool operator==(const FaceWindow&) const = default;
};

class MeshScene {
 public:
  /// Throws GpuError if Embree can not be had.
  MeshScene();
  ~MeshScene();

  /// An empty model removes what was there. The instrument's part "Bur" is_bur about its z axis.
  void setModel(Model model, const assets::MeshModel& mesh);
  /// At first as in a frame of default values.
  void place(const Placements& placements, const FaceWindow& window = {});

  bool hasTransparent() const;

  /// The first opaque place along every ray, 0 mm where there is none, in two halves: face and gingiva, which stay what
  /// they are for the same rays until staticRevision() changes; then the instruments, where they lie before them.
  void staticHits(const RayBatch& rays, MeshHits& hits) const;
  void addDynamicHits(const RayBatch& rays, MeshHits& hits) const;
  std::uint64_t staticRevision() const;
  /// Adds those hits that are what the ray sees: nothing at `seen_mm[i]` before them.
  void addSeen(const RayBatch& rays, const MeshHits& hits, const float* seen_mm, MeshPoints& to) const;
  /// Every transparent place before `limit_mm[i]`, and of what is seen through bone and gingiva all that lies before
  /// the opaque face and instruments; ray by ray, each ray's from back to front.
  void layers(const RayBatch& rays, const float* limit_mm, MeshPoints& to) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
