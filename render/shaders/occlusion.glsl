// Soft shade from the coarse ambient map of the volume, so that a carved hole reads as a hole: five cones for the room
// (after Crassin et al. 2011, voxel cone tracing), one march towards the lamp.
#include "volume_block.glsl"
#include "lighting.glsl"

float coneOpenness(vec3 index, vec3 direction) {
  float near = crowdingAt(index + 5.0 * direction), far = crowdingAt(index + 11.0 * direction);
  return (1.0 - near) * (1.0 - 0.75 * far);
}

Shade shadeFromVolume(vec3 p_P, vec3 normal) {
  if (volume.ambient_size.x == 0) return Shade(1.0, 1.0);
  vec3 index = indexFromPoint(p_P);
  vec3 side = normalize(abs(normal.x) < 0.7 ? cross(normal, vec3(1, 0, 0)) : cross(normal, vec3(0, 1, 0)));
  vec3 other = cross(normal, side);

  // Four cones at 45 degrees and one upright.
  float open = coneOpenness(index, normal);
  const float tilt = 0.70710678;
  open += tilt * (coneOpenness(index, tilt * (normal + side)) + coneOpenness(index, tilt * (normal - side)) +
                  coneOpenness(index, tilt * (normal + other)) + coneOpenness(index, tilt * (normal - other)));
  open /= 1.0 + 4.0 * tilt;

  // Towards the lamp, with growing steps.
  vec3 to_lamp = normalize(eye.lamp_P.xyz - p_P);
  float through = 1.0;
  float t = 6.0;
  for (int i = 0; i < 7; ++i) {
    through *= 1.0 - smoothstep(0.25, 1.0, crowdingAt(index + 2.0 * normal + t * to_lamp));
    t *= 1.45;
  }
  return Shade(open * open, mix(0.12, 1.0, through));
}
