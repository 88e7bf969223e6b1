// What the rays of a batch see, in light that the display can show: meshes, tooth and bone, what is translucent before
// them, the dark room behind. Opaque meshes first, so that the caster ends at them; only what is seen is shaded; layers
// are laid over it from back to front. The scene is shared by all threads, a painter belongs to one. Frame P, mm.
#pragma once

#include <vector>

#include "render/cpu/mesh_points.h"
#include "render/cpu/mesh_scene.h"
#include "render/cpu/shade_kernels.h"
#include "render/cpu/solid_cells.h"
#include "render/cpu/volume_cast.h"

namespace render {

/// An eye's scene; everything is borrowed.
struct PaintScene {
  const MeshScene* meshes = nullptr;
  const SolidCells* cells = nullptr;
  CastSettings cast;
  const OpacityTable* opacity = nullptr;               ///< set where tooth and bone are translucent …
  const BorderedField<std::uint8_t>* label = nullptr;  ///< … by tissue
  ShadeScene shade;
  const ShadeKernels* kernels = nullptr;
};

class RayPainter {
 public:
  static constexpr int kMost = RayBatch::kMost;

  RayPainter();

  /// Rays through `count` places of the picture, 0..1 from its lower left. `still`: what they meet of face and gum,
  /// filled in unless `still_is_known` from an earlier picture through the same places; null: not kept.
  void paint(const PaintScene& scene, int count, MeshHits* still = nullptr, bool still_is_known = false);

  alignas(64) float place_x[kMost + kLanePadding] = {}, place_y[kMost + kLanePadding] = {};  ///< to be filled in
  // Answers.
  alignas(64) float r[kMost + kLanePadding] = {}, g[kMost + kLanePadding] = {}, b[kMost + kLanePadding] = {};
  alignas(64) float distance_mm[kMost + kLanePadding] = {};  ///< to what is seen, 0: nothing

 private:
  Light roomFor(int count);
  void paintSurface(const PaintScene& scene);
  void paintThrough(const PaintScene& scene);
  void background(const PaintScene& scene);
  void meshes(const PaintScene& scene, const float* seen_mm);
  void layers(const PaintScene& scene);

  RayBatch rays_;
  MeshHits hits_;
  MeshPoints seen_, clear_;
  VolumePoints volume_;
  RaySums sums_;
  std::vector<float> light_;
  alignas(64) float limit_mm_[kMost + kLanePadding] = {};
};

}  // namespace render
