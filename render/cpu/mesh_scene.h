// Face, gingiva and instruments for rays on the CPU: a two-level Embree scene, with the instruments posed in each
// frame. Frame P, mm. Opaque parts and a faded face yield the first hit, transparent ones all hits along a ray, back to
// front. The face window cuts as in shaders/mesh_colour.glsl. Both sides of a triangle are hit, in mirrored views too.
// Cost: setModel builds a tree (20 ms for 35,000 triangles); place() takes some microseconds, a ray about 30 ns.
// Thread: setModel and place on one thread; then any number of threads may trace.
#pragma once

#include "render/cpu/mesh_bodies.h"
#include "render/cpu/mesh_points.h"

namespace render {

class MeshScene : private MeshBodies {
 public:
  using MeshBodies::place;
  using MeshBodies::setModel;
  using MeshBodies::staticRevision;

  bool hasVeil() const { return has(MeshGroup::veil); }
  bool hasTransparent() const { return hasVeil() || has(MeshGroup::transparent) || has(MeshGroup::overlay); }

  /// The first opaque hit of every ray, 0 mm if there is none, in two steps: face and gingiva, which stay valid for the
  /// same rays until staticRevision() changes; then the instruments, where they are nearer.
  void staticHits(const RayBatch& rays, MeshHits& hits) const;
  /// The first hit on the faded face, 0 mm if there is none; valid as long as staticHits().
  void veilHits(const RayBatch& rays, MeshHits& hits) const;
  void addDynamicHits(const RayBatch& rays, MeshHits& hits) const;
  /// Appends the hits that are visible: not behind `seen_mm[i]`.
  void addSeen(const RayBatch& rays, const MeshHits& hits, const float* seen_mm, MeshPoints& to) const;
  /// Appends every transparent hit before `limit_mm[i]`, those of the veil (null: none) among them, and the overlay
  /// hits not hidden by the opaque face and instruments; ray by ray, each ray's from back to front.
  void layers(const RayBatch& rays, const float* limit_mm, const MeshHits* veil, MeshPoints& to) const;
};

}  // namespace render
