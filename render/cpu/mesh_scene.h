// Face, gingiva and instruments for rays on the CPU: a two-level Embree scene, with the instruments posed in each
// frame. Frame P, mm. Opaque parts yield the first hit, transparent ones all hits along a ray, back to front. The face
// window cuts as in shaders/mesh_colour.glsl. Both sides of a triangle are hit, in mirrored views too. Cost: setModel
// builds a tree (20 ms for 35,000 triangles); place some microseconds; a ray about 30 ns. Thread: setModel and place on
// one thread; then any number of threads may trace.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "assets/mesh.h"
#include "render/cpu/mesh_points.h"
#include "render/scene/models.h"

namespace render {

/// The hole in the face around the line from the eyes to the site.
struct FaceWindow {
  glm::vec3 eye_P{0.0f}, site_P{0.0f};
  float radius_mm = 0.0f;  ///< 0: none
  bool operator==(const FaceWindow&) const = default;
};

class MeshScene {
 public:
  /// Throws GpuError if Embree is not available.
  MeshScene();
  ~MeshScene();

  /// An empty model removes the previous one. The instrument's part "Bur" rotates about its z axis.
  void setModel(Model model, const assets::MeshModel& mesh);
  /// Initially as for a default Frame.
  void place(const Placements& placements, const FaceWindow& window = {});

  bool hasTransparent() const;

  /// The first opaque hit of every ray, 0 mm if there is none, in two steps: face and gingiva, which stay valid for the
  /// same rays until staticRevision() changes; then the instruments, where they are nearer.
  void staticHits(const RayBatch& rays, MeshHits& hits) const;
  void addDynamicHits(const RayBatch& rays, MeshHits& hits) const;
  std::uint64_t staticRevision() const;
  /// Appends the hits that are visible: not behind `seen_mm[i]`.
  void addSeen(const RayBatch& rays, const MeshHits& hits, const float* seen_mm, MeshPoints& to) const;
  /// Appends every transparent hit before `limit_mm[i]`, and the overlay hits not hidden by the opaque face and
  /// instruments; ray by ray, each ray's from back to front.
  void layers(const RayBatch& rays, const float* limit_mm, MeshPoints& to) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
