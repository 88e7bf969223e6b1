// Marks of the instrument on soft tissue: cuts of a turning bur, reddened places. C++: soft_marks.h; CPU twin:
// cpu/soft_body.h. Without any mark nothing changes.
#include "soft_block.glsl"
#include "soft_constants.glsl"
#include "lighting.glsl"

// mm from the surface of the nearest cut, negative inside.
float cutDistance(vec3 p_P) {
  float away = SOFT_FAR;
  if (soft.counts.x == 0 || distance(p_P, soft.bound_P.xyz) > soft.bound_P.w) return away;
  for (int n = 0; n < soft.counts.x; ++n) {
    vec3 offset = p_P - soft.cut_from_P[n].xyz, way = soft.cut_way_P[n].xyz;
    float at = clamp(dot(offset, way) * soft.cut_way_P[n].w, 0.0, 1.0);
    away = min(away, length(offset - at * way) - soft.cut_from_P[n].w);
  }
  return away;
}

// `away`: cutDistance.
Surface marked(Surface s, vec3 p_P, float away) {
  float red = 0.0;
  for (int n = 0; n < soft.counts.y; ++n) {
    vec3 offset = p_P - soft.reddened_P[n].xyz;
    red += soft.share[n].x * exp2(-min(soft.reddened_P[n].w * dot(offset, offset), SOFT_FARTHEST));
  }
  s.albedo = mix(s.albedo, s.albedo * vec3(SOFT_RED_TINT), min(red, 1.0));

  float wound = 1.0 - smoothstep(SOFT_RIM_FROM, SOFT_RIM_WIDTH, away);
  float deep = mix(SOFT_DEEP_SHADE, 1.0, smoothstep(SOFT_DEEP_TO, SOFT_DEEP_FROM, away));
  s.albedo = mix(s.albedo, deep * vec3(SOFT_WOUND_COLOUR), SOFT_WOUND_COVER * wound);
  s.roughness = mix(s.roughness, min(s.roughness, SOFT_WOUND_ROUGHNESS), wound);
  return s;
}
