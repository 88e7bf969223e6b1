// Guides on the bone: bands of clearance to the canal and what is planned to go. Told apart by value and pattern as well
// as by hue, for eyes that do not tell red from green (hues of Okabe and Ito, "Color universal design", 2008).
#include "volume_block.glsl"

const vec3 kNear = vec3(0.66, 0.11, 0.0), kMiddle = vec3(0.79, 0.35, 0.0), kFar = vec3(0.87, 0.77, 0.06);
const vec3 kPlanned = vec3(0.09, 0.46, 0.81), kRim = vec3(0.0, 0.08, 0.30);

// mm to the canal's wall and to the planned cut.
vec2 guideDistances(vec3 index) {
  vec2 share = textureLod(guide_field, (index + 0.5) / (float(AMBIENT_CELL_VOXELS) * vec3(volume.ambient_size.xyz)), 0.0).rg;
  return mix(vec2(GUIDE_LOW_MM), vec2(GUIDE_HIGH_MM), share);
}

float lineAt(float distance_mm, float half_width_mm) {
  return 1.0 - smoothstep(0.6 * half_width_mm, 1.4 * half_width_mm, abs(distance_mm));
}

// Nearer than 1 mm full, to 2 mm striped, to 3 mm dotted; a dark line ends each band.
vec3 withClearance(vec3 albedo, float mm, vec3 p_P) {
  if (mm > 3.2) return albedo;
  float stripes = smoothstep(0.35, 0.5, abs(fract(0.55 * (p_P.x + p_P.y + p_P.z)) - 0.5) * 2.0);
  vec3 cell = fract(1.1 * p_P) - 0.5;
  float dots = 1.0 - smoothstep(0.30, 0.42, length(cell));
  vec3 band = mm < 1.0 ? kNear : mm < 2.0 ? kMiddle : kFar;
  float cover = mm < 1.0 ? 0.85 : mm < 2.0 ? mix(0.45, 0.85, stripes) : mm < 3.0 ? mix(0.25, 0.80, dots) : 0.0;
  float ends = max(lineAt(mm - 1.0, 0.07), max(lineAt(mm - 2.0, 0.07), lineAt(mm - 3.0, 0.07)));
  return mix(mix(albedo, band, cover), 0.25 * band, ends);
}

vec3 withPlan(vec3 albedo, float mm) {
  albedo = mix(albedo, kPlanned, 0.42 * (1.0 - smoothstep(-0.05, 0.05, mm)));
  return mix(albedo, kRim, 0.9 * lineAt(mm, 0.14));
}

// What the guides that are switched on make of a colour at a place.
vec3 guided(vec3 albedo, vec3 index, vec3 p_P) {
  if (volume.march.w == 0.0) return albedo;
  int shown = int(volume.march.w);
  vec2 mm = guideDistances(index);
  if ((shown & GUIDE_CLEARANCE) != 0) albedo = withClearance(albedo, mm.x, p_P);
  if ((shown & GUIDE_PLAN) != 0) albedo = withPlan(albedo, mm.y);
  return albedo;
}
