// Traces and shades a batch of rays: meshes, tooth and bone, transparent layers, background; tone-mapped. Opaque meshes
// first, so that the caster ends at them; only visible hits are shaded; layers are blended from back to front.
// The scene is shared by all threads, a tracer belongs to one. Frame P, mm.
#pragma once

#include <memory>
#include <vector>

#include "render/cpu/mesh_points.h"
#include "render/cpu/mesh_scene.h"
#include "render/cpu/shade_kernels.h"
#include "render/cpu/solid_cells.h"
#include "render/cpu/volume_cast.h"

namespace render {

/// The scene of an eye; everything is borrowed.
struct TraceScene {
  const MeshScene* meshes = nullptr;
  const SolidCells* cells = nullptr;
  CastSettings cast;
  const OpacityTable* opacity = nullptr;  ///< for the translucent view, with `label`
  const BorderedField<std::uint8_t>* label = nullptr;
  ShadeScene shade;
  const ShadeKernels* kernels = nullptr;
  const TraceScene* reflected = nullptr;  ///< what the eye sees in the second hand's mirror; null: nothing
};

/// First hits on what stands still, kept from frame to frame while the eye does too.
struct StaticHits {
  MeshHits* opaque = nullptr;
  MeshHits* veil = nullptr;  ///< of the faded face
  bool are_valid = false;    ///< else they are filled in
};

class RayTracer {
 public:
  static constexpr int kMaxRays = RayBatch::kMaxRays;

  RayTracer();

  /// Rays through the first `count` points of uv. Hits without a place in `kept` are not kept.
  void trace(const TraceScene& scene, int count, const StaticHits& kept = {});

  alignas(64) float uv_x[kMaxRays + kLanePadding] = {}, uv_y[kMaxRays + kLanePadding] =
                                                            {};  ///< input: image points, 0..1 from the lower left
  // Results.
  alignas(64) float r[kMaxRays + kLanePadding] = {}, g[kMaxRays + kLanePadding] = {}, b[kMaxRays + kLanePadding] = {};
  alignas(64) float distance_mm[kMaxRays + kLanePadding] = {};  ///< 0: nothing hit
  /// The same, but what is seen in the glass as far as its image lies behind it.
  const float* seen_mm() const { return has_glass_ ? image_mm_ : distance_mm; }

 private:
  Light roomFor(int count);
  void scatter(const Light& light, const std::int32_t* ray, int count);
  void traceSurface(const TraceScene& scene);
  void traceTranslucent(const TraceScene& scene);
  void background(const TraceScene& scene);
  void meshes(const TraceScene& scene, const float* seen_mm);
  void inGlass(const TraceScene& scene, const Light& light);
  void traceLight(const TraceScene& scene, int count, const StaticHits& kept);
  void layers(const TraceScene& scene, const StaticHits& kept);

  RayBatch rays_;
  MeshHits hits_, veil_;
  MeshPoints seen_, transparent_;
  VolumePoints volume_;
  RaySums sums_;
  std::vector<float> light_;
  std::unique_ptr<RayTracer> reflected_;  ///< from the first ray that meets a glass
  bool has_glass_ = false;
  alignas(64) float image_mm_[kMaxRays + kLanePadding] = {};
  alignas(64) float limit_mm_[kMaxRays + kLanePadding] = {};
};

}  // namespace render
