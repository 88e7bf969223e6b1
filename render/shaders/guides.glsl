// Guides on the bone: bands of clearance to the canal, and the planned cut. They differ in value and pattern as well as
// hue, for red-green colour blindness (hues of Okabe and Ito, "Color universal design", 2008).
#include "volume_block.glsl"
#include "light_constants.glsl"

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
  if (mm > GUIDE_SHOWN_TO) return albedo;
  float stripes = smoothstep(0.35, 0.5, abs(fract(GUIDE_STRIPES_PER_MM * (p_P.x + p_P.y + p_P.z)) - 0.5) * 2.0);
  vec3 cell = fract(GUIDE_DOTS_PER_MM * p_P) - 0.5;
  float dots = 1.0 - smoothstep(0.30, 0.42, length(cell));
  vec3 band = mm < 1.0   ? vec3(GUIDE_NEAR_COLOUR)
              : mm < 2.0 ? vec3(GUIDE_MIDDLE_COLOUR)
                         : vec3(GUIDE_FAR_COLOUR);
  float cover = mm < 1.0   ? GUIDE_FULL_COVER
                : mm < 2.0 ? mix(GUIDE_STRIPE_GAP_COVER, GUIDE_FULL_COVER, stripes)
                : mm < 3.0 ? mix(GUIDE_DOT_GAP_COVER, GUIDE_DOT_COVER, dots)
                           : 0.0;
  float ends = max(lineAt(mm - 1.0, GUIDE_BAND_END),
                   max(lineAt(mm - 2.0, GUIDE_BAND_END), lineAt(mm - 3.0, GUIDE_BAND_END)));
  return mix(mix(albedo, band, cover), 0.25 * band, ends);
}

vec3 withPlan(vec3 albedo, float mm) {
  albedo = mix(albedo, vec3(GUIDE_PLANNED_COLOUR), GUIDE_PLAN_COVER * (1.0 - smoothstep(-0.05, 0.05, mm)));
  return mix(albedo, vec3(GUIDE_RIM_COLOUR), GUIDE_PLAN_RIM_COVER * lineAt(mm, GUIDE_PLAN_RIM));
}

// Translucent matter shows the plan only; clearance bands are drawn on surfaces.
vec3 planned(vec3 albedo, vec3 index) {
  return (int(volume.march.w) & GUIDE_PLAN) == 0 ? albedo : withPlan(albedo, guideDistances(index).y);
}

// Applies the visible guides to the colour of a surface point. Bone is planned for removal, enamel never: the coarse field
// of the plan reaches over the crown beside it.
vec3 guided(vec3 albedo, vec3 index, vec3 p_P, float enamel) {
  if (volume.march.w == 0.0) return albedo;
  int shown = int(volume.march.w);
  vec2 mm = guideDistances(index);
  if ((shown & GUIDE_CLEARANCE) != 0) albedo = withClearance(albedo, mm.x, p_P);
  if ((shown & GUIDE_PLAN) != 0) albedo = mix(withPlan(albedo, mm.y), albedo, enamel);
  return albedo;
}
