// Light and opacity of translucent matter along a ray, front to back, at the samples of ray_march.glsl.
// Opacity is per mm and corrected for the step: alpha = 1 - (1 - a)^(step in mm). Lengths in voxels.
#include "ray_march.glsl"
#include "lighting.glsl"
#include "guides.glsl"
#include "tool_shade.glsl"

// C++ twin: render::TransferBlock.
layout(std140, binding = TRANSFER_BLOCK) uniform TransferBlock {
  vec4 ramp;                          // x: solid fraction where opacity begins, y: 1 over the length of the ramp
  vec4 opacity_per_mm[TISSUE_COUNT];  // x: of the full tissue, y: of its wall
} transfer;

struct Gathered {
  vec4 light;       // premultiplied
  float reach;      // length at which the opacity reaches one half; negative: never
};

float opacityPerMm(vec3 position) {
  float share = clamp((solidAt(position) - transfer.ramp.x) * transfer.ramp.y, 0.0, 1.0);
  if (share <= 0.0) return 0.0;
  vec2 per_mm = transfer.opacity_per_mm[labelAt(position)].xy;
  return per_mm.x * share + per_mm.y * (1.0 - per_mm.x) * 4.0 * share * (1.0 - share);
}

// Light scattered by matter: lamp (evaluated once per ray) and room; without a surface all directions count alike.
vec3 scattered(vec3 position, vec3 to_lamp, vec3 lamp_light) {
  vec3 gradient = outwardGradientAt(position);
  float steep = length(gradient);
  vec3 normal = gradient / max(steep, 1e-6);
  float surface = min(steep / DVR_FULL_GRADIENT, 1.0);
  float lambert = mix(DVR_INNER_LAMBERT, max(dot(normal, to_lamp), 0.0), surface);
  float sky = 0.5 + 0.5 * surface * dot(normal, eye.up_P.xyz);
  vec3 p_P = volume.origin_P.xyz + position * volume.origin_P.w;
  lambert *= lampPastTool(p_P, to_lamp);
  vec3 light = planned(appearanceAt(position).rgb, position) * (lambert / 3.14159265 * lamp_light + mix(kFloorLight, kSkyLight, sky));
  return underRing(light, p_P);
}

Gathered gatherAlong(vec3 origin, vec3 direction, float begin, float limit) {
  Gathered gathered = Gathered(vec4(0.0), -1.0);
  vec2 span = spanInVolume(origin, direction);
  vec3 middle_P = volume.origin_P.xyz + (origin + 0.5 * (span.x + span.y) * direction) * volume.origin_P.w;
  span = vec2(max(span.x, begin), min(span.y, limit));
  if (span.x >= span.y) return gathered;
  float step = volume.march.x;
  float step_mm = step * volume.origin_P.w;
  vec3 entry = origin + span.x * direction;
  int last = int((span.y - span.x) / step);
  vec3 lamp_offset = eye.lamp_P.xyz - middle_P;
  float lamp_distance = length(lamp_offset);
  vec3 to_lamp = lamp_offset / lamp_distance;
  vec3 lamp_light = lampRadiance(middle_P, to_lamp, lamp_distance);

  int k = 0;
  while (k <= last && gathered.light.a < DVR_OPAQUE) {
    vec3 position = entry + (float(k) * step) * direction;
    if (skips(k, position, entry, direction)) continue;
    float per_mm = opacityPerMm(position);
    if (per_mm > 0.0) {
      float share = (1.0 - gathered.light.a) * (1.0 - pow(1.0 - per_mm, step_mm));
      gathered.light += share * vec4(scattered(position, to_lamp, lamp_light), 1.0);
      if (gathered.reach < 0.0 && gathered.light.a >= DVR_SOLID) gathered.reach = span.x + float(k) * step;
    }
    ++k;
  }
  return gathered;
}
