#include "render/cpu/ray_tracer.h"

#include <algorithm>

#include "render/shaders/light_constants.glsl"
#include "render/shaders/shared_constants.glsl"

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
  traceLight(scene, count, kept);
  scene.kernels->shoulder({r, g, b}, count);
}

void RayTracer::traceLight(const TraceScene& scene, int count, const StaticHits& kept) {
  has_glass_ = false;
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
  // Translucent matter before the glass hides its image.
  for (int i = 0; has_glass_ && i < count; ++i)
    if (image_mm_[i] < 0.0f || distance_mm[i] != hits_.distance_mm[i]) image_mm_[i] = distance_mm[i];
  layers(scene, kept);
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
  if (scene.reflected != nullptr) inGlass(scene, light);
  scatter(light, seen_.ray, seen_.count);
}

// Where the eye sees the glass: the same points of the image once more, from behind it. glass.glsl.
void RayTracer::inGlass(const TraceScene& scene, const Light& light) {
  const auto reflects = [this](int n) { return seen_.finish[n] == FINISH_GLASS && seen_.faces_eye[n] != 0; };
  if (!reflected_) {
    bool any = false;
    for (int n = 0; n < seen_.count && !any; ++n) any = reflects(n);
    if (!any) return;
    reflected_ = std::make_unique<RayTracer>();
  }
  RayTracer& there = *reflected_;
  int count = 0;
  for (int n = 0; n < seen_.count; ++n) {
    if (!reflects(n)) continue;
    there.uv_x[count] = uv_x[seen_.ray[n]];
    there.uv_y[count++] = uv_y[seen_.ray[n]];
  }
  if (count == 0) return;
  there.traceLight(*scene.reflected, count, {});

  has_glass_ = true;
  std::fill_n(image_mm_, rays_.count, -1.0f);
  constexpr float kFog[] = {GLASS_FOG_COLOUR};
  const float fog = scene.shade.eye.glass.y;
  const auto through = [&](float seen, float veil) { return GLASS_KEEPS * (seen + fog * (veil - seen)); };
  for (int n = 0, m = 0; n < seen_.count; ++n) {
    if (!reflects(n)) continue;
    light.r[n] = through(there.r[m], kFog[0]);
    light.g[n] = through(there.g[m], kFog[1]);
    light.b[n] = through(there.b[m], kFog[2]);
    image_mm_[seen_.ray[n]] = there.distance_mm[m++];
  }
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
