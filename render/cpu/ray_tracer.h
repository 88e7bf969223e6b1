// What the rays of a batch see, in light that the display can show: meshes, tooth and bone, what is translucent before
// them, the dark room behind. Opaque meshes first, so that the caster ends at them; only what is seen is shaded; layers
// are laid over it from back to front. The scene is shared by all threads, a tracer belongs to one. Frame P, mm.
#pragma once

#include <vector>

#include "render/cpu/mesh_points.h"
#include "render/cpu/mesh_scene.h"
#include "render/cpu/shade_kernels.h"
#include "render/cpu/solid_cells.h"
#include "render/cpu/volume_cast.h"

namespace render {

/// An eye's scene; everything is borrowed.
struct TraceScene {
  const MeshScene* meshes = nullptr;
  const SolidCells* cells = nullptr;
  CastSettings cast;
  const OpacityTable* opacity = nullptr;               ///< set where tooth and bone are translucent …
  const BorderedField<std::uint8_t>* label = nullptr;  ///< … by tissue
  ShadeScene shade;
  const ShadeKernels* kernels = nullptr;
};

class RayTracer {
 public:
  static constexpr int kMaxRays = RayBatch::kMaxRays;

  RayTracer();

  /// Rays through `count` places of the image, 0..1 from its lower left. `still`: what they meet of face and gingiva,
  /// filled in unless `static_hits_valid` from an earlier image through the same places; null: not kept.
  void trace(const TraceScene& scene, int count, MeshHits* still = nullptr, bool static_hits_valid = false);

  alignas(64) float uv_x[kMaxRays + kLanePadding] = {}, uv_y[kMaxRays + kLanePadding] = {};  ///< to be filled in
  // Answers.
  alignas(64) float r[kMaxRays + kLanePadding] = {}, g[kMaxRays + kLanePadding] = {}, b[kMaxRays + kLanePadding] = {};
  alignas(64) float distance_mm[kMaxRays + kLanePadding] = {};  ///< to what is seen, 0: nothing

 private:
  Light roomFor(int count);
  void traceSurface(const TraceScene& scene);
  void traceTranslucent(const TraceScene& scene);
  void background(const TraceScene& scene);
  void meshes(const TraceScene& scene, const float* seen_mm);
  void layers(const TraceScene& scene);

  RayBatch rays_;
  MeshHits hits_;
  MeshPoints seen_, transparent_parts_;
  VolumePoints volume_;
  RaySums sums_;
  std::vector<float> light_;
  alignas(64) float limit_mm_[kMaxRays + kLanePadding] = {};
};

}  // namespace render
