// Colours of the tissues, and how neighbouring labels melt into one another.
// Linear-sRGB albedos and roughness: starting values judged by eye on CT surfaces; enamel is translucent (wrap, high F0).
#include "volume_block.glsl"
#include "lighting.glsl"

struct TissueLook {
  vec3 albedo;
  float roughness;
  float f0;
  float wrap;
  float presence;   // how much a voxel counts for the colour of a hard surface beside it: soft tissue hardly does
};

const TissueLook kTissueLook[TISSUE_COUNT] = TissueLook[](
    TissueLook(vec3(0.72, 0.615, 0.46), 0.52, 0.040, 0.10, 0.02),   // unlabelled: a scan without segmentation reads as bone
    TissueLook(vec3(0.74, 0.63, 0.47), 0.48, 0.040, 0.10, 1.0),   // cortical
    TissueLook(vec3(0.58, 0.30, 0.21), 0.42, 0.035, 0.15, 1.0),   // trabecular, only seen freshly cut: marrow and blood
    TissueLook(vec3(0.70, 0.655, 0.54), 0.24, 0.050, 0.25, 1.0),   // other teeth
    TissueLook(vec3(0.75, 0.73, 0.66), 0.18, 0.055, 0.30, 1.0),   // enamel
    TissueLook(vec3(0.78, 0.64, 0.38), 0.50, 0.045, 0.15, 1.0),   // dentine
    TissueLook(vec3(0.45, 0.06, 0.06), 0.35, 0.030, 0.20, 0.5),   // pulp
    TissueLook(vec3(0.90, 0.80, 0.30), 0.40, 0.030, 0.20, 0.5),   // canal
    TissueLook(vec3(0.66, 0.36, 0.30), 0.45, 0.030, 0.20, 0.05),   // ligament
    TissueLook(vec3(0.60, 0.22, 0.22), 0.35, 0.020, 0.30, 0.02));  // gingiva

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

// The look of the matter just below a surface place: labels of 27 voxels weighted by a quadratic B-spline and by how much
// solid each holds, so that neither the air outside nor the voxel edges show.
Surface tissueSurface(vec3 index, vec3 normal, vec3 p_P) {
  vec3 below = index - 0.7 * normal;
  ivec3 centre = ivec3(floor(below + 0.5));
  vec3 f = below - vec3(centre);
  vec3 w[3] = vec3[](0.5 * (0.5 - f) * (0.5 - f), 0.75 - f * f, 0.5 * (0.5 + f) * (0.5 + f));
  vec3 albedo = vec3(0.0);
  vec3 finish = vec3(0.0);
  float marrow = 0.0, total = 0.0;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        ivec3 voxel = clamp(centre + ivec3(i, j, k) - 1, ivec3(0), volume.size.xyz - 1);
        float solid = texelFetch(solid_field, voxel, 0).r;
        uint label = min(texelFetch(label_field, voxel, 0).r, uint(TISSUE_COUNT - 1));
        TissueLook look = kTissueLook[label];
        float weight = w[i].x * w[j].y * w[k].z * (solid * solid + 1e-4) * look.presence;
        albedo += weight * look.albedo;
        finish += weight * vec3(look.roughness, look.f0, look.wrap);
        marrow += label == 2u ? weight : 0.0;
        total += weight;
      }
  albedo /= total;
  finish /= total;
  marrow /= total;

  // Bone is never even: faint mottling, and pores full of blood where the marrow lies open.
  float mottle = noise(p_P * 0.9) * 0.6 + noise(p_P * 3.1) * 0.4 - 0.5;
  albedo *= 1.0 + 0.14 * mottle * finish.x;
  float pore = smoothstep(0.42, 0.68, noise(p_P * 2.3) * 0.7 + noise(p_P * 5.7) * 0.3);
  albedo = mix(albedo, vec3(0.36, 0.09, 0.07), 0.75 * pore * marrow);
  return Surface(albedo, vec3(finish.y), finish.x, finish.z, albedo);
}
