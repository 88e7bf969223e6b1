#include "render/cpu/ray_tracer.h"

#include <algorithm>

namespace render {
namespace {

constexpr float kEndless_mm = 1e9f;

}  // namespace

RayTracer::RayTracer() { light_.resize(3 * static_cast<std::size_t>(kMaxRays + 2 * kLanePadding)); }

Light RayTracer::roomFor(int count) {
  const std::size_t stride = (static_cast<std::size_t>(count) + 2 * kLanePadding) & ~std::size_t{kLanePadding - 1};
  if (light_.size() < 3 * stride) light_.resize(3 * stride);
  return {light_.data(), light_.data() + stride, light_.data() + 2 * stride};
}

void RayTracer::scatter(const Light& light, const std::int32_t* ray, int count) {
  for (int n = 0; n < count; ++n) r[ray[n]] = light.r[n], g[ray[n]] = light.g[n], b[ray[n]] = light.b[n];
}

void RayTracer::trace(const TraceScene& scene, int count, const StaticHits& kept) {
  rays_.count = count;
  scene.kernels->aim(scene.shade.eye, uv_x, uv_y, rays_);
  if (!kept.are_valid) scene.meshes->staticHits(rays_, kept.opaque != nullptr ? *kept.opaque : hits_);
  if (kept.opaque != nullptr) hits_ = *kept.opaque;
  scene.meshes->addDynamicHits(rays_, hits_);
  for (int i = 0; i < count; ++i) {
    distance_mm[i] = hits_.distance_mm[i];
    limit_mm_[i] = distance_mm[i] > 0.0f ? distance_mm[i] : kEndless_mm;
  }
  volume_.clear();
  if (scene.opacity == nullptr)
    traceSurface(scene);
  else
    traceTranslucent(scene);
  layers(scene, kept);
  scene.kernels->shoulder({r, g, b}, count);
}

// The surface is opaque: only visible points are shaded.
void RayTracer::traceSurface(const TraceScene& scene) {
  castSurface(*scene.cells, scene.cast, rays_, limit_mm_, volume_);
  for (int n = 0; n < volume_.count; ++n) {
    const auto at = static_cast<std::size_t>(n);
    distance_mm[volume_.ray[at]] = volume_.length[at] * scene.cast.spacing_mm;
  }
  background(scene);
  meshes(scene, distance_mm);
  if (volume_.count == 0) return;
  const Light light = roomFor(volume_.count);
  scene.kernels->surface(scene.shade, rays_, volume_.ray.data(), volume_.length.data(), volume_.count, light);
  scatter(light, volume_.ray.data(), volume_.count);
}

// Translucent matter is blended over everything behind it; its distance is where the opacity reaches one half.
void RayTracer::traceTranslucent(const TraceScene& scene) {
  background(scene);
  meshes(scene, hits_.distance_mm);
  castTranslucent(*scene.cells, scene.cast, *scene.label, *scene.opacity, rays_, limit_mm_, volume_, sums_);
  for (int i = 0; i < rays_.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float left = 1.0f - sums_.opacity[at];
    r[i] *= left, g[i] *= left, b[i] *= left;
    if (sums_.reach[at] >= 0.0f) distance_mm[i] = sums_.reach[at] * scene.cast.spacing_mm;
  }
  if (volume_.count == 0) return;
  const Light light = roomFor(volume_.count);
  scene.kernels->matter(scene.shade, rays_, volume_.ray.data(), volume_.length.data(), volume_.count, light);
  for (int n = 0; n < volume_.count; ++n) {
    const int ray = volume_.ray[static_cast<std::size_t>(n)];
    const float weight = volume_.weight[static_cast<std::size_t>(n)];
    r[ray] += weight * light.r[n], g[ray] += weight * light.g[n], b[ray] += weight * light.b[n];
  }
}

void RayTracer::background(const TraceScene& scene) {
  if (std::find(distance_mm, distance_mm + rays_.count, 0.0f) != distance_mm + rays_.count)
    scene.kernels->background(scene.shade.eye, rays_, uv_x, uv_y, {r, g, b});
}

void RayTracer::meshes(const TraceScene& scene, const float* seen_mm) {
  seen_.clear();
  scene.meshes->addSeen(rays_, hits_, seen_mm, seen_);
  if (seen_.count == 0) return;
  const Light light = roomFor(seen_.count);
  scene.kernels->meshes(scene.shade, rays_, seen_, light);
  scatter(light, seen_.ray, seen_.count);
}

// The layers of each ray are sorted back to front.
void RayTracer::layers(const TraceScene& scene, const StaticHits& kept) {
  if (!scene.meshes->hasTransparent()) return;
  MeshHits& veil = kept.veil != nullptr ? *kept.veil : veil_;
  if (scene.meshes->hasVeil() && !(kept.veil != nullptr && kept.are_valid)) scene.meshes->veilHits(rays_, veil);
  for (int i = 0; i < rays_.count; ++i) limit_mm_[i] = distance_mm[i] > 0.0f ? distance_mm[i] : kEndless_mm;
  transparent_.clear();
  scene.meshes->layers(rays_, limit_mm_, scene.meshes->hasVeil() ? &veil : nullptr, transparent_);
  if (transparent_.count == 0) return;
  const Light light = roomFor(transparent_.count);
  scene.kernels->meshes(scene.shade, rays_, transparent_, light);
  for (int n = 0; n < transparent_.count; ++n) {
    const int ray = transparent_.ray[n];
    const float a = transparent_.a[n];
    r[ray] += a * (light.r[n] - r[ray]);
    g[ray] += a * (light.g[n] - g[ray]);
    b[ray] += a * (light.b[n] - b[ray]);
  }
}

}  // namespace render
