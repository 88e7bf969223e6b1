// Ambient occlusion and lamp shadow from the coarse ambient map: five cones for the room (after Crassin et al. 2011,
// voxel cone tracing), one march towards the lamp.
#include "volume_block.glsl"
#include "lighting.glsl"

// Open share of a cone of about 45 degrees, from the density of three points along it.
float coneOpenness(vec3 index, vec3 direction, float first) {
  float near = densityAt(index + first * direction);
  float middle = densityAt(index + CONE_SECOND * first * direction);
  float far = densityAt(index + CONE_THIRD * first * direction);
  return (1.0 - near) * (1.0 - CONE_SECOND_SHADE * middle) * (1.0 - CONE_THIRD_SHADE * far);
}

// Open share of the room: four cones at 45 degrees and one upright. `first`: voxels to the first sample, beyond the
// blur of the surface's own cells.
float openness(vec3 index, vec3 normal, float first) {
  vec3 side = normalize(abs(normal.x) < 0.7 ? cross(normal, vec3(1, 0, 0)) : cross(normal, vec3(0, 1, 0)));
  vec3 other = cross(normal, side);
  const float tilt = CONE_TILT;
  float open = coneOpenness(index, normal, first);
  open += tilt * (coneOpenness(index, tilt * (normal + side), first) + coneOpenness(index, tilt * (normal - side), first) +
                  coneOpenness(index, tilt * (normal + other), first) + coneOpenness(index, tilt * (normal - other), first));
  open /= 1.0 + 4.0 * tilt;
  return open * sqrt(open);
}

// Share of the lamp's light that arrives, sampled with growing steps.
float lampThrough(vec3 index, vec3 normal, vec3 to_lamp, float first) {
  float through = 1.0;
  float t = first;
  for (int i = 0; i < LAMP_SAMPLES; ++i) {
    through *= 1.0 - smoothstep(LAMP_CLEAR, LAMP_BLOCKED, densityAt(index + LAMP_LIFT * first * normal + t * to_lamp));
    t *= LAMP_STEP_GROWTH;
  }
  return mix(LAMP_MIN, 1.0, through);
}

Visibility visibilityFromVolume(vec3 p_P, vec3 normal) {
  Visibility visibility = Visibility(1.0, 1.0);
  if (volume.ambient_size.x == 0) return visibility;
  vec3 index = indexFromPoint(p_P);
  float first = max(CONE_FIRST_CELLS * float(AMBIENT_CELL_VOXELS), CONE_FIRST_MM / volume.origin_P.w);
  if (volume.march.y > 0.0) visibility.ambient = openness(index, normal, first);
  if (volume.march.z > 0.0) visibility.lamp = lampThrough(index, normal, normalize(eye.lamp_P.xyz - p_P), first);
  return visibility;
}
