// Where a ray first meets the surface solid = 0.5.
// Samples lie at fixed places t = k * kStep from the entry into the volume, whether empty space is skipped or not, so
// that both find the very same surface. Length unit here: voxels.
#include "volume_block.glsl"

const float kIso = 0.5;
const float kStep = 0.5;
const int kBisections = 6;
const float kGuard = 1e-3;  // a skip ends this much early, so that rounding never carries it past an occupied brick

// The part of the ray inside the volume and its border of air one voxel wide; empty when near > far.
vec2 spanInVolume(vec3 origin, vec3 direction) {
  vec3 inverse = 1.0 / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
  vec3 a = (vec3(-1.0) - origin) * inverse;
  vec3 b = (vec3(volume.size.xyz) - origin) * inverse;
  vec3 low = min(a, b), high = max(a, b);
  return vec2(max(max(low.x, low.y), max(low.z, 0.0)), min(high.x, min(high.y, high.z)));
}

// Length from `entry` to the end of the empty bricks around `place`; 0 where the brick is occupied.
float emptyLength(vec3 place, vec3 entry, vec3 direction) {
  ivec3 brick = clamp(ivec3(floor(place)) / BRICK_VOXELS, ivec3(0), volume.bricks.xyz - 1);
  int bricks_to_solid = int(texelFetch(emptiness, brick, 0).r);
  if (bricks_to_solid == 0) return 0.0;
  vec3 low = vec3((brick - bricks_to_solid + 1) * BRICK_VOXELS), high = vec3((brick + bricks_to_solid) * BRICK_VOXELS);
  vec3 inverse = 1.0 / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
  vec3 leave = (mix(low, high, greaterThan(direction, vec3(0.0))) - entry) * inverse;
  return min(leave.x, min(leave.y, leave.z)) - kGuard;
}

// Length along the unit direction to the surface, negative where there is none before `limit`.
float castRay(vec3 origin, vec3 direction, float limit) {
  vec2 span = spanInVolume(origin, direction);
  span.y = min(span.y, limit);
  if (span.x >= span.y) return -1.0;
  vec3 entry = origin + span.x * direction;
  int last = int((span.y - span.x) / kStep);

  // March until a sample is solid.
  int k = 0;
  bool found = false;
  while (k <= last) {
    vec3 place = entry + (float(k) * kStep) * direction;
    if (volume.size.w != 0) {
      float leave = emptyLength(place, entry, direction);
      if (leave != 0.0) {
        k = max(k + 1, int(ceil(leave / kStep)));
        continue;
      }
    }
    if (solidAt(place) >= kIso) {
      found = true;
      break;
    }
    ++k;
  }
  if (!found) return -1.0;
  if (k == 0) return span.x;

  // Close in on the surface between the last two samples.
  float low = float(k - 1) * kStep, high = float(k) * kStep;
  for (int i = 0; i < kBisections; ++i) {
    float middle = 0.5 * (low + high);
    if (solidAt(entry + middle * direction) >= kIso)
      high = middle;
    else
      low = middle;
  }
  return span.x + high;
}

// Outward normal of the surface: central differences of the smoothed field, so that no voxel shows as a terrace.
vec3 surfaceNormal(vec3 place) {
  const vec2 h = vec2(1.0, 0.0);
  vec3 slope = vec3(smoothAt(place + h.xyy) - smoothAt(place - h.xyy), smoothAt(place + h.yxy) - smoothAt(place - h.yxy),
                    smoothAt(place + h.yyx) - smoothAt(place - h.yyx));
  return -slope * inversesqrt(max(dot(slope, slope), 1e-12));
}
