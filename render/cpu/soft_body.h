// soft_marks.glsl in lanes. Included only by the kernels (shade_kernel.cpp); internal linkage.
#pragma once

#include "render/cpu/light_body.h"
#include "render/shaders/soft_constants.glsl"

namespace render::cpu {
namespace {

inline Float cutDistance(const SoftBlock& soft, const Float3& p_P, Mask mask) {
  Float away = splat(SOFT_FAR);
  if (soft.counts.x == 0) return away;
  const Mask near = mask & (length(p_P - splat(soft.bound_P)) <= soft.bound_P.w);
  if (!any(near)) return away;
  for (std::size_t n = 0; n < static_cast<std::size_t>(soft.counts.x); ++n) {
    const Float3 offset = p_P - splat(soft.cut_from_P[n]), way = splat(soft.cut_way_P[n]);
    const Float at = clamp(dot(offset, way) * soft.cut_way_P[n].w, 0.0f, 1.0f);
    away = minimum(away, length(offset - at * way) - soft.cut_from_P[n].w);
  }
  return select(near, away, splat(SOFT_FAR));
}

inline Surface marked(const SoftBlock& soft, Surface s, const Float3& p_P, Mask mask) {
  if (soft.counts.y > 0) {
    Float red = splat(0.0f);
    for (std::size_t n = 0; n < static_cast<std::size_t>(soft.counts.y); ++n) {
      const Float3 offset = p_P - splat(soft.reddened_P[n]);
      red += soft.share[n].x * exp2(-minimum(soft.reddened_P[n].w * dot(offset, offset), SOFT_FARTHEST));
    }
    s.albedo = mix(s.albedo, s.albedo * vec3(SOFT_RED_TINT), minimum(red, 1.0f));
  }
  const Float away = cutDistance(soft, p_P, mask);
  if (any(mask & (away < SOFT_RIM_WIDTH))) {
    const Float wound = 1.0f - smoothStep(SOFT_RIM_FROM, SOFT_RIM_WIDTH, away);
    const Float deep = SOFT_DEEP_SHADE + (1.0f - SOFT_DEEP_SHADE) * smoothStep(SOFT_DEEP_TO, SOFT_DEEP_FROM, away);
    s.albedo = mix(s.albedo, deep * vec3(SOFT_WOUND_COLOUR), SOFT_WOUND_COVER * wound);
    s.roughness = mix(s.roughness, minimum(s.roughness, SOFT_WOUND_ROUGHNESS), wound);
  }
  return s;
}

}  // namespace
}  // namespace render::cpu
