// surgical_field.glsl in lanes. Included only by the kernels (shade_kernel.cpp); internal linkage.
#pragma once

#include "render/cpu/light_body.h"
#include "render/shaders/field_constants.glsl"

namespace render::cpu {
namespace {

inline Float3 maximum(const Float3& a, const Float3& b) {
  return {maximum(a.x, b.x), maximum(a.y, b.y), maximum(a.z, b.z)};
}

inline bool isCovered(const EyeBlock& eye) { return eye.field_cover != glm::vec4(0.0f); }

inline Float nearSite(const EyeBlock& eye, const Float3& p_P) {
  const Float3 offset = p_P - splat(eye.field_P);
  return exp2(-minimum(eye.field_P.w * dot(offset, offset), FIELD_FARTHEST));
}

inline Float hollowness(Float open) { return smoothStep(FIELD_HOLLOW_FROM, FIELD_HOLLOW_TO, 1.0f - open); }

inline Surface covered(const EyeBlock& eye, Surface s, const Float3& p_P, const Float3& normal, Float marrow,
                       Float mottle, Float open) {
  if (!isCovered(eye)) return s;
  const glm::vec4& cover = eye.field_cover;
  const Float close = nearSite(eye, p_P), hollow = hollowness(open);

  // Blood from cut marrow, in streaks beside it, and in hollows.
  const Float bleeding = marrow * FIELD_MARROW_BLEEDS * smoothStep(FIELD_BLOOD_FROM, FIELD_BLOOD_TO, mottle);
  const Float streaks = FIELD_STREAKS * close * smoothStep(FIELD_STREAKS_FROM, FIELD_STREAKS_TO, mottle);
  const Float blood = cover.y * maximum(bleeding, streaks);
  s.albedo = mix(s.albedo, vec3(FIELD_HOLLOW_COLOUR), FIELD_HOLLOW_COVER * hollow);
  s.albedo = mix(s.albedo, vec3(FIELD_BLOOD_COLOUR), blood);

  // The film of water, thicker where blood and hollows hold it.
  const Float even = clamp(cover.x * (0.5f + 0.5f * close) * (1.0f + FIELD_FILM_PATCHES * mottle), 0.0f, 1.0f);
  const Float film = maximum(even, maximum(blood, hollow));
  s.albedo = (1.0f - FIELD_WET_DARKENS * film * (1.0f - s.wrap)) * s.albedo;
  s.roughness = mix(s.roughness, minimum(s.roughness, FIELD_WET_ROUGHNESS), film);
  s.f0 = mix(s.f0, maximum(s.f0, vec3(FIELD_WET_F0, FIELD_WET_F0, FIELD_WET_F0)), film);

  // Dust lies on what faces up.
  const Float slope = FIELD_DUST_SLOPE * dot(normal, splat(eye.up_P));
  const Float dust = cover.z * close * smoothStep(FIELD_DUST_FROM, FIELD_DUST_TO, mottle + slope);
  s.albedo = mix(s.albedo, vec3(FIELD_DUST_COLOUR), dust);
  s.roughness = mix(s.roughness, splat(FIELD_DUST_ROUGHNESS), dust);
  s.wrap *= 1.0f - dust;
  s.scatter = s.albedo;
  return s;
}

inline Visibility litHollow(const EyeBlock& eye, Visibility visibility) {
  if (!isCovered(eye)) return visibility;
  const Float hollow = hollowness(visibility.ambient);
  visibility.ambient = maximum(visibility.ambient, FIELD_HOLLOW_AMBIENT * hollow);
  visibility.lamp = maximum(visibility.lamp, FIELD_HOLLOW_LAMP * hollow);
  return visibility;
}

inline Float3 throughSpray(const EyeBlock& eye, const Float3& light, const Float3& p_P) {
  if (eye.field_cover.w == 0.0f) return light;
  return mix(light, vec3(FIELD_SPRAY_COLOUR), (FIELD_SPRAY_COVER * eye.field_cover.w) * nearSite(eye, p_P));
}

}  // namespace
}  // namespace render::cpu
