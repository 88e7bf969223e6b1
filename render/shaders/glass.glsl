// Light from the glass of a dental mirror: the scene as the reflected eye sees it in the same pixel, drawn before, dimmed
// by the silver and by fog. CPU twin: RayTracer::inGlass().
#include "eye_block.glsl"
#include "light_constants.glsl"

layout(binding = REFLECTED_LIGHT_UNIT) uniform sampler2D reflected_light;

vec3 inGlass(ivec2 pixel) {
  vec3 seen = texelFetch(reflected_light, pixel, 0).rgb;
  return GLASS_KEEPS * mix(seen, vec3(GLASS_FOG_COLOUR), eye.glass.y);
}
