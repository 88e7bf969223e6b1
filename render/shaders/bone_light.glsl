// Light reflected by a point of the bone surface against a ray direction, for rays and triangles.
#include "ray_cast.glsl"
#include "tissue_appearance.glsl"
#include "occlusion.glsl"
#include "tool_shade.glsl"

vec3 boneLight(vec3 index, vec3 p_P, vec3 direction) {
  vec3 normal = surfaceNormal(index);
  Visibility open = visibilityFromVolume(p_P, normal);
  Surface surface = tissueSurface(index, normal, p_P, open.ambient);
  Visibility visibility = besideTool(litHollow(open), p_P, normal);
  return underRing(throughSpray(lit(surface, p_P, normal, -direction, visibility), p_P), p_P);
}
