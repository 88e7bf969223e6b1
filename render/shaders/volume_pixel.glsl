// Tooth and bone in one pixel, up to the meshes in front: the body of the fragment and of the compute caster.
#include "bone_light.glsl"
#include "ray_translucent.glsl"

layout(binding = SCENE_DISTANCE_UNIT) uniform sampler2D scene_distance;  // of the meshes, 0: none

struct VolumePixel {
  vec4 light;         // premultiplied; 0 outside the volume
  float distance_mm;  // along the ray; 0: nothing solid
};

VolumePixel surfacePixel(vec3 eye_index, vec3 direction, float begin, float limit) {
  float t = castRay(eye_index, direction, begin, limit);
  if (t < 0.0) return VolumePixel(vec4(0.0), 0.0);
  vec3 index = eye_index + t * direction;
  vec3 p_P = eye.eye_P.xyz + (t * volume.origin_P.w) * direction;
  return VolumePixel(vec4(boneLight(index, p_P, direction), 1.0), t * volume.origin_P.w);
}

VolumePixel translucentPixel(vec3 eye_index, vec3 direction, float begin, float limit) {
  Gathered gathered = gatherAlong(eye_index, direction, begin, limit);
  return VolumePixel(gathered.light, max(gathered.reach, 0.0) * volume.origin_P.w);
}

VolumePixel volumeAt(ivec2 pixel) {
  vec3 direction = rayDirection((vec2(pixel) + 0.5) / vec2(textureSize(scene_distance, 0)));
  float in_front_mm = texelFetch(scene_distance, pixel, 0).r;
  float limit = in_front_mm > 0.0 ? in_front_mm / volume.origin_P.w : 1e9;
  float begin = rayBegin(direction) / volume.origin_P.w;
  vec3 eye_index = indexFromPoint(eye.eye_P.xyz);
  return volume.bricks.w == VIEW_DVR ? translucentPixel(eye_index, direction, begin, limit)
                                     : surfacePixel(eye_index, direction, begin, limit);
}
