// Surface of tooth and bone: colour and finish from the appearance field (C++: appearance_field.h), reflectance of the
// finish, and fine detail that no scan resolves. Values chosen by eye; enamel is translucent (wrap, high F0).
#include "volume_block.glsl"
#include "surgical_field.glsl"
#include "guides.glsl"
#include "paint.glsl"

float hashed(ivec3 cell) {
  uvec3 q = uvec3(cell) * uvec3(1597334673u, 3812015801u, 2798796415u);
  uint h = (q.x ^ q.y ^ q.z) * 1597334673u;
  return float(h >> 8) / 16777216.0;
}

// Value noise 0..1 with a period of one.
float noise(vec3 x) {
  ivec3 cell = ivec3(floor(x));
  vec3 f = fract(x);
  f = f * f * (3.0 - 2.0 * f);
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    vec3 w = mix(1.0 - f, f, vec3(corner));
    sum += w.x * w.y * w.z * hashed(cell + corner);
  }
  return sum;
}

// Material of the matter just below a surface point, where the scan has no partial volume, and what covers it.
// `index`, `outward` and `grain`: the point, its normal and its mm where the matter was scanned; `p_P` and `normal`: where
// it is now. `open`: share of the room that is seen from there.
Surface tissueAt(vec3 index, vec3 outward, vec3 grain, vec3 p_P, vec3 normal, float open, out float enamel) {
  vec4 appearance = appearanceAt(index - COLOUR_DEPTH_VOXELS * outward);
  vec3 albedo = appearance.rgb;
  enamel = clamp(2.0 * appearance.a - 1.0, 0.0, 1.0);
  float marrow = clamp(1.0 - 2.0 * appearance.a, 0.0, 1.0);
  vec3 shine = mix(mix(FINISH_DULL, FINISH_MARROW, marrow), FINISH_ENAMEL, enamel);

  // Faint mottling, and blood-filled pores in open marrow.
  float mottle = noise(grain * 0.9) * 0.6 + noise(grain * 3.1) * 0.4 - 0.5;
  albedo *= 1.0 + 0.14 * mottle * shine.x;
  float pore = smoothstep(0.42, 0.68, noise(grain * 2.3) * 0.7 + noise(grain * 5.7) * 0.3);
  albedo = mix(albedo, vec3(0.36, 0.09, 0.07), 0.75 * pore * marrow);
  return covered(Surface(albedo, vec3(shine.y), shine.x, shine.z, albedo), p_P, normal, marrow, mottle, open);
}

// Of what lies where it was scanned, with paint and guides.
Surface tissueSurface(vec3 index, vec3 normal, vec3 p_P, float open) {
  float enamel;
  Surface surface = tissueAt(index, normal, p_P, p_P, normal, open, enamel);
  surface.albedo = guided(painted(surface.albedo, index), index, p_P, enamel);
  surface.scatter = surface.albedo;
  return surface;
}
