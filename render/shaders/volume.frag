#version 450
// Tooth and bone: one ray per pixel to the surface solid = 0.5, lit, with the depth that triangles would have there.
#include "ray_cast.glsl"
#include "tissue_look.glsl"
#include "occlusion.glsl"

layout(binding = SCENE_DISTANCE_UNIT) uniform sampler2D scene_distance;
layout(location = 0) in vec2 place;
layout(location = COLOUR_TARGET) out vec4 colour;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  vec3 direction = rayDirection(place);
  float in_front_mm = texelFetch(scene_distance, ivec2(gl_FragCoord.xy), 0).r;
  float limit = in_front_mm > 0.0 ? in_front_mm / volume.origin_P.w : 1e9;
  vec3 eye_index = indexFromPoint(eye.eye_P.xyz);
  float t = castRay(eye_index, direction, limit);
  if (t < 0.0) discard;

  vec3 index = eye_index + t * direction;
  vec3 p_P = eye.eye_P.xyz + (t * volume.origin_P.w) * direction;
  vec3 normal = surfaceNormal(index);
  Surface surface = tissueSurface(index, normal, p_P);
  colour = vec4(lit(surface, p_P, normal, -direction, shadeFromVolume(p_P, normal)), 1.0);
  distance_mm = t * volume.origin_P.w;
  gl_FragDepth = depthOf(p_P);
}
