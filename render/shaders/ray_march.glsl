// Sampling of a ray through the volume, shared by surface and translucent view: samples lie at t = k * step from the
// entry, with or without skipping of empty space, so that both give the same image. Lengths in voxels.
#include "volume_block.glsl"

const float kGuard = 1e-3;  // a skip ends this much early, so that rounding cannot carry it past an occupied brick

// The part of the ray inside the volume and its border of air one voxel wide; empty when near > far.
vec2 spanInVolume(vec3 origin, vec3 direction) {
  vec3 inverse = 1.0 / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
  vec3 a = (vec3(-1.0) - origin) * inverse;
  vec3 b = (vec3(volume.size.xyz) - origin) * inverse;
  vec3 low = min(a, b), high = max(a, b);
  return vec2(max(max(low.x, low.y), max(low.z, 0.0)), min(high.x, min(high.y, high.z)));
}

// Length from `entry` to the end of the empty bricks around `position`; 0 where the brick is occupied.
float emptyLength(vec3 position, vec3 entry, vec3 direction) {
  ivec3 brick = clamp(ivec3(floor(position)) / BRICK_VOXELS, ivec3(0), volume.bricks.xyz - 1);
  int bricks_to_solid = int(texelFetch(emptiness, brick, 0).r);
  if (bricks_to_solid == 0) return 0.0;
  vec3 low = vec3((brick - bricks_to_solid + 1) * BRICK_VOXELS), high = vec3((brick + bricks_to_solid) * BRICK_VOXELS);
  vec3 inverse = 1.0 / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
  vec3 leave = (mix(low, high, greaterThan(direction, vec3(0.0))) - entry) * inverse;
  return min(leave.x, min(leave.y, leave.z)) - kGuard;
}

// Whether sample k, at `position`, lies in empty bricks; if so k advances to the first sample behind them.
bool skips(inout int k, vec3 position, vec3 entry, vec3 direction) {
  if (volume.size.w == 0) return false;
  float leave = emptyLength(position, entry, direction);
  if (leave == 0.0) return false;
  k = max(k + 1, int(ceil(leave / volume.march.x)));
  return true;
}

// Negative gradient of the smoothed field over two voxels, by central differences; points towards air.
vec3 outwardGradientAt(vec3 position) {
  const vec2 h = vec2(1.0, 0.0);
  return vec3(smoothAt(position - h.xyy) - smoothAt(position + h.xyy), smoothAt(position - h.yxy) - smoothAt(position + h.yxy),
              smoothAt(position - h.yyx) - smoothAt(position + h.yyx));
}
