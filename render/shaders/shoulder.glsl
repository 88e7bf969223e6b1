// Tone mapping: bright values roll off towards white instead of clipping. Identity up to the knee.
#include "light_constants.glsl"

vec3 shoulder(vec3 x) {
  vec3 over = max(x - SHOULDER_KNEE, 0.0) / (1.0 - SHOULDER_KNEE);
  return min(x, SHOULDER_KNEE) + (1.0 - SHOULDER_KNEE) * (over / (1.0 + over));
}

// Inverse of shoulder() for y < 1.
vec3 inverseShoulder(vec3 y) {
  vec3 risen = clamp((y - SHOULDER_KNEE) / (1.0 - SHOULDER_KNEE), 0.0, 0.999);
  return min(y, SHOULDER_KNEE) + (1.0 - SHOULDER_KNEE) * (risen / (1.0 - risen));
}
