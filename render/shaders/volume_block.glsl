// The volume. Positions are continuous voxel indices, integer at voxel centres. C++ twin: VolumeBlock.
#include "shared_constants.glsl"

layout(std140, binding = VOLUME_BLOCK) uniform VolumeBlock {
  vec4 origin_P;         // centre of voxel (0,0,0); w: spacing, mm
  ivec4 size;            // voxels; w: 1 to skip empty space
  ivec4 bricks;          // w: VIEW_…
  ivec4 ambient_size;    // cells of the ambient map; x is 0 when there is no volume
  vec4 march;            // x: voxels between samples; y, z: 1 for ambient occlusion, for the lamp shadow; w: GUIDE_… bits
  ivec4 paint_low;       // voxel at which the painted box begins
  ivec4 paint_size;      // its voxels; w: 1 where there is paint
} volume;

layout(binding = SOLID_UNIT) uniform sampler3D solid_field;
layout(binding = SMOOTH_UNIT) uniform sampler3D smooth_field;
layout(binding = LABEL_UNIT) uniform usampler3D label_field;
layout(binding = APPEARANCE_UNIT) uniform sampler3D appearance_field;
layout(binding = GUIDE_UNIT) uniform sampler3D guide_field;
layout(binding = PAINT_UNIT) uniform sampler3D paint_field;
layout(binding = EMPTINESS_UNIT) uniform usampler3D emptiness;
layout(binding = AMBIENT_UNIT) uniform sampler3D ambient_map;

vec3 indexFromPoint(vec3 p_P) { return (p_P - volume.origin_P.xyz) / volume.origin_P.w; }

// Solid fraction 0..1, trilinear, air outside.
float solidAt(vec3 index) { return textureLod(solid_field, (index + 0.5) / vec3(volume.size.xyz), 0.0).r; }

// The same smoothed, for normals.
float smoothAt(vec3 index) { return textureLod(smooth_field, (index + 0.5) / vec3(volume.size.xyz), 0.0).r; }

// Colour (linear) and finish, trilinear in the stored roots, clamped to the edge.
vec4 appearanceAt(vec3 index) {
  vec3 inside = clamp(index, vec3(0.0), vec3(volume.size.xyz - 1));
  vec4 appearance = textureLod(appearance_field, (inside + 0.5) / vec3(volume.size.xyz), 0.0);
  return vec4(appearance.rgb * appearance.rgb, appearance.a);
}

// Mean solid fraction of the surrounding cells, 0..1, trilinear, air outside.
float densityAt(vec3 index) {
  return textureLod(ambient_map, (index + 0.5) / (float(AMBIENT_CELL_VOXELS) * vec3(volume.ambient_size.xyz)), 0.0).r;
}

// Tissue of the nearest voxel.
uint labelAt(vec3 index) {
  ivec3 voxel = clamp(ivec3(floor(index + 0.5)), ivec3(0), volume.size.xyz - 1);
  return min(texelFetch(label_field, voxel, 0).r, uint(TISSUE_COUNT - 1));
}
