// The kernels of a blade, included once by each instruction set's source, which defines MOLAR_KERNEL_SET. Helpers have
// internal linkage. Loops over sixteen lanes for the compiler's vectoriser.
#pragma once

#include "haptics/ligament/blade_kernels.h"
#include "haptics/ligament/hold_sample_body.h"

namespace haptics {
namespace {

constexpr int kBladeLanes = 16;

inline Three placedOn(const BladePlace& place, float x, float y, float z) {
  const float* m = place.turn;
  return {m[0] * x + m[1] * y + m[2] * z + place.shift[0], m[3] * x + m[4] * y + m[5] * z + place.shift[1],
          m[6] * x + m[7] * y + m[8] * z + place.shift[2]};
}

struct Gap {
  float mm;
  Three out;
};

inline Gap gapAt(const BladeOutline& blade, Three p) {
  // Outline: inside the nearest edge, outside the nearest point of it.
  float inside = -1e9f, inside_u = 1.0f, inside_v = 0.0f, least2 = 1e18f, way_u = 0.0f, way_v = 0.0f;
#pragma GCC unroll 4
  for (int n = 0; n < 4; ++n) {
    const float out_u = blade.out[n][0], out_v = blade.out[n][1];
    const float beyond = p.x * out_u + p.y * out_v - blade.offset[n];
    const bool farther = beyond > inside;
    inside = farther ? beyond : inside;
    inside_u = farther ? out_u : inside_u;
    inside_v = farther ? out_v : inside_v;
    const float u = p.x - blade.corner[n][0], v = p.y - blade.corner[n][1];
    const float along_u = blade.along[n][0], along_v = blade.along[n][1];
    const float share = lesser(greater((u * along_u + v * along_v) * blade.per_length2[n], 0.0f), 1.0f);
    const float near_u = u - share * along_u, near_v = v - share * along_v;
    const float square = near_u * near_u + near_v * near_v;
    const bool nearer = square < least2;
    least2 = nearer ? square : least2;
    way_u = nearer ? near_u : way_u;
    way_v = nearer ? near_v : way_v;
  }
  const bool is_out = inside > 0.0f;
  const float outside = __builtin_sqrtf(greater(least2, 1e-20f)), per_outside = 1.0f / outside;
  const float flat = is_out ? outside : inside;
  const float flat_u = is_out ? way_u * per_outside : inside_u, flat_v = is_out ? way_v * per_outside : inside_v;

  // Drawn along a line: outside of both round the edge, else the larger.
  const float side = p.z < 0.0f ? -1.0f : 1.0f, over = side * p.z - blade.half;
  const float round = __builtin_sqrtf(greater(flat * flat + over * over, 1e-20f)), per_round = 1.0f / round;
  const bool is_round = flat > 0.0f && over > 0.0f, is_flat = flat > over;
  const float core = is_round ? round : greater(flat, over);
  const float of_flat = is_round ? flat * per_round : (is_flat ? 1.0f : 0.0f);
  const float of_side = is_round ? over * per_round : (is_flat ? 0.0f : 1.0f);
  const float edge = core - blade.edge_radius;

  // Shank: a capsule along the shaft.
  const bool along_u = blade.shaft == 0;
  const float axial = along_u ? p.x : p.y, lateral = along_u ? p.y : p.x;
  const float past = axial - lesser(greater(axial, blade.shank_from), blade.shank_to);
  const float arm = __builtin_sqrtf(greater(lateral * lateral + p.z * p.z + past * past, 1e-20f)), per_arm = 1.0f / arm;
  const float shank = arm - blade.shank_radius;
  const bool is_shank = shank < edge;
  const float shank_u = (along_u ? past : lateral) * per_arm, shank_v = (along_u ? lateral : past) * per_arm;
  return {is_shank ? shank : edge,
          {is_shank ? shank_u : of_flat * flat_u, is_shank ? shank_v : of_flat * flat_v,
           is_shank ? p.z * per_arm : of_side * side}};
}

}  // namespace

namespace MOLAR_KERNEL_SET {

int nearBlade(const BladeOutline& outline, const BladePlace& where, const BladeSamples& samples, float within,
              std::uint16_t* index, int most) noexcept {
  const BladeOutline blade = outline;
  const BladePlace place = where;
  const float* __restrict x = samples.x, * __restrict y = samples.y, * __restrict z = samples.z;
  const float reach2 = (blade.reach + within) * (blade.reach + within);
  const float shank2 = (blade.shank_radius + within) * (blade.shank_radius + within);
  const bool along_u = blade.shaft == 0;
  int count = 0;
  alignas(64) int is_near[kBladeLanes];
  for (int first = 0; first < samples.count; first += kBladeLanes) {
    int any = 0;
    for (int n = 0; n < kBladeLanes; ++n) {
      const Three p = placedOn(place, x[first + n], y[first + n], z[first + n]);
      const float u = p.x - blade.middle[0], v = p.y - blade.middle[1], s = p.z - blade.middle[2];
      const float axial = along_u ? p.x : p.y, lateral = along_u ? p.y : p.x;
      const float past = axial - lesser(greater(axial, blade.shank_from), blade.shank_to);
      const float least = lesser(u * u + v * v + s * s - reach2, lateral * lateral + p.z * p.z + past * past - shank2);
      is_near[n] = least < 0.0f ? 1 : 0;
      any |= is_near[n];
    }
    if (any == 0) continue;
    for (int n = 0; n < kBladeLanes && count < most; ++n) {
      index[count] = static_cast<std::uint16_t>(first + n);
      count += is_near[n];
    }
  }
  return count;
}

void bladeGaps(const BladeOutline& outline, const BladePlace& where, const BladeSamples& samples,
               const BladeGaps& gaps) noexcept {
  const BladeOutline blade = outline;
  const BladePlace place = where;
  const float* __restrict x = samples.x, * __restrict y = samples.y, * __restrict z = samples.z;
  float* __restrict gap = gaps.gap;
  float* __restrict out_u = gaps.out_u;
  float* __restrict out_v = gaps.out_v;
  float* __restrict out_s = gaps.out_s;
  alignas(64) float row[4][kBladeLanes];
  for (int first = 0; first < samples.count; first += kBladeLanes) {
    for (int n = 0; n < kBladeLanes; ++n) {
      const Gap here = gapAt(blade, placedOn(place, x[first + n], y[first + n], z[first + n]));
      row[0][n] = here.mm;
      row[1][n] = here.out.x;
      row[2][n] = here.out.y;
      row[3][n] = here.out.z;
    }
    for (int n = 0; n < kBladeLanes; ++n) gap[first + n] = row[0][n];
    for (int n = 0; n < kBladeLanes; ++n) out_u[first + n] = row[1][n];
    for (int n = 0; n < kBladeLanes; ++n) out_v[first + n] = row[2][n];
    for (int n = 0; n < kBladeLanes; ++n) out_s[first + n] = row[3][n];
  }
}

}  // namespace MOLAR_KERNEL_SET
}  // namespace haptics
