// Light reflected by a point of the bone surface against a ray direction, for rays and triangles.
#include "ray_cast.glsl"
#include "tissue_appearance.glsl"
#include "occlusion.glsl"
#include "tool_shade.glsl"

vec3 boneLight(vec3 index, vec3 p_P, vec3 direction) {
  vec3 normal = surfaceNormal(index);
  Surface surface = tissueSurface(index, normal, p_P);
  Visibility visibility = besideTool(visibilityFromVolume(p_P, normal), p_P, normal);
  return underRing(lit(surface, p_P, normal, -direction, visibility), p_P);
}
