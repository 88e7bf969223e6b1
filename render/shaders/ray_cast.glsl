// First hit of a ray with the surface solid = 0.5. Lengths in voxels.
#include "ray_march.glsl"

const float kIso = 0.5;
const int kBisections = 6;

// Length along the unit direction to the surface, negative if there is none between `begin` and `limit`.
float castRay(vec3 origin, vec3 direction, float begin, float limit) {
  vec2 span = spanInVolume(origin, direction);
  span.x = max(span.x, begin);
  span.y = min(span.y, limit);
  if (span.x >= span.y) return -1.0;
  float step = volume.march.x;
  vec3 entry = origin + span.x * direction;
  int last = int((span.y - span.x) / step);

  // March until a sample is solid.
  int k = 0;
  bool found = false;
  while (k <= last) {
    vec3 position = entry + (float(k) * step) * direction;
    if (skips(k, position, entry, direction)) continue;
    if (solidAt(position) >= kIso) {
      found = true;
      break;
    }
    ++k;
  }
  if (!found) return -1.0;
  if (k == 0) return span.x;

  // Bisect between the last two samples.
  float low = float(k - 1) * step, high = float(k) * step;
  for (int i = 0; i < kBisections; ++i) {
    float middle = 0.5 * (low + high);
    if (solidAt(entry + middle * direction) >= kIso)
      high = middle;
    else
      low = middle;
  }
  return span.x + high;
}

// Outward normal of the surface.
vec3 surfaceNormal(vec3 position) {
  vec3 gradient = outwardGradientAt(position);
  return gradient * inversesqrt(max(dot(gradient, gradient), 1e-12));
}
