// The kernels of a piece's hold, included once by each instruction set's source, which defines MOLAR_KERNEL_SET.
// Helpers have internal linkage, so that the sets share no code. Loops over sixteen lanes for the compiler's
// vectoriser.
#pragma once

#include "haptics/ligament/hold_kernels.h"
#include "haptics/ligament/hold_sample_body.h"

namespace haptics {
namespace {

constexpr int kLanes = 16, kTerms = 28, kEnergy = 27;

/// Sixteen samples where they are now, and the obstacles there.
struct Row {
  float arm[3][kLanes], by[3][kLanes], gap[kLanes], in[3][kLanes];
};

void place16(const HoldSamples& s, const HoldPlace& place, int first, Row& __restrict row) {
  const float* __restrict x = s.x + first, * __restrict y = s.y + first, * __restrict z = s.z + first;
  for (int n = 0; n < kLanes; ++n) {
    const Moved moved = movedTo(place, {x[n], y[n], z[n]});
    row.arm[0][n] = moved.arm.x;
    row.arm[1][n] = moved.arm.y;
    row.arm[2][n] = moved.arm.z;
    row.by[0][n] = moved.by.x;
    row.by[1][n] = moved.by.y;
    row.by[2][n] = moved.by.z;
  }
}

void lookAround(const HoldPlace& place, Row& __restrict row) {
  alignas(64) int at[kLanes];
  alignas(64) float x[kLanes], y[kLanes], z[kLanes], corner[8][kLanes];
  for (int n = 0; n < kLanes; ++n) {
    const InCell cell = cellAt(place, {row.arm[0][n], row.arm[1][n], row.arm[2][n]});
    at[n] = cell.at;
    x[n] = cell.x;
    y[n] = cell.y;
    z[n] = cell.z;
  }
  const int row_step = place.size[0], layer_step = place.size[0] * place.size[1];
  const auto gather = [&](int offset, float* __restrict to) {
    const float* distance = place.distance + offset;
    for (int n = 0; n < kLanes; ++n) to[n] = distance[at[n]];
  };
  gather(0, corner[0]);
  gather(1, corner[1]);
  gather(row_step, corner[2]);
  gather(row_step + 1, corner[3]);
  gather(layer_step, corner[4]);
  gather(layer_step + 1, corner[5]);
  gather(layer_step + row_step, corner[6]);
  gather(layer_step + row_step + 1, corner[7]);
  for (int n = 0; n < kLanes; ++n) {
    const Nearby near = nearbyIn(place.per_mm, {at[n], x[n], y[n], z[n]}, corner[0][n], corner[1][n], corner[2][n],
                                 corner[3][n], corner[4][n], corner[5][n], corner[6][n], corner[7][n]);
    row.gap[n] = near.gap;
    row.in[0][n] = near.in.x;
    row.in[1][n] = near.in.y;
    row.in[2][n] = near.in.z;
  }
}

/// Adds lanes in their order. Terms: 6 of the gradient, 21 of the Hessian, energy.
void addLanes(const float lane[kTerms][kLanes], HoldSums& sums) {
  double total[kTerms];
  for (int term = 0; term < kTerms; ++term) {
    total[term] = 0.0;
    for (int n = 0; n < kLanes; ++n) total[term] += static_cast<double>(lane[term][n]);
  }
  for (int term = 0; term < 6; ++term) sums.gradient[term] += total[term];
  for (int term = 0; term < 21; ++term) sums.hessian[term] += total[6 + term];
  sums.energy += total[kEnergy];
}

/// Force f and stiffness k of one sample at an arm r, into lane n: J' f and J' k J with J = [1, -[r]x].
struct Stiffness {
  float xx, xy, xz, yy, yz, zz;
};
inline void addSample(float lane[kTerms][kLanes], int n, Three r, Three f, const Stiffness& k, float energy) {
  lane[0][n] += f.x;
  lane[1][n] += f.y;
  lane[2][n] += f.z;
  lane[3][n] += r.y * f.z - r.z * f.y;
  lane[4][n] += r.z * f.x - r.x * f.z;
  lane[5][n] += r.x * f.y - r.y * f.x;
  // Columns of -k [r]x
  const float xa = k.xz * r.y - k.xy * r.z, xb = k.xx * r.z - k.xz * r.x, xc = k.xy * r.x - k.xx * r.y;
  const float ya = k.yz * r.y - k.yy * r.z, yb = k.xy * r.z - k.yz * r.x, yc = k.yy * r.x - k.xy * r.y;
  const float za = k.zz * r.y - k.yz * r.z, zb = k.xz * r.z - k.zz * r.x, zc = k.yz * r.x - k.xz * r.y;
  lane[6][n] += k.xx;
  lane[7][n] += k.xy;
  lane[8][n] += k.xz;
  lane[9][n] += xa;
  lane[10][n] += xb;
  lane[11][n] += xc;
  lane[12][n] += k.yy;
  lane[13][n] += k.yz;
  lane[14][n] += ya;
  lane[15][n] += yb;
  lane[16][n] += yc;
  lane[17][n] += k.zz;
  lane[18][n] += za;
  lane[19][n] += zb;
  lane[20][n] += zc;
  lane[21][n] += r.y * za - r.z * ya;
  lane[22][n] += r.y * zb - r.z * yb;
  lane[23][n] += r.y * zc - r.z * yc;
  lane[24][n] += r.z * xb - r.x * zb;
  lane[25][n] += r.z * xc - r.x * zc;
  lane[26][n] += r.x * yc - r.y * xc;
  lane[kEnergy][n] += energy;
}

template <bool kHasField>
void sumLigament(const HoldConstants& constants, const HoldSamples& samples, const HoldPlace& where, HoldSums& sums) {
  const HoldConstants law = constants;
  const HoldSamples s = samples;
  const HoldPlace place = where;
  alignas(64) float lane[kTerms][kLanes] = {};
  alignas(64) Row row;
  for (int first = 0; first < s.ligament; first += kLanes) {
    place16(s, place, first, row);
    if constexpr (kHasField) lookAround(place, row);
    for (int n = 0; n < kLanes; ++n) {
      const int v = first + n;
      const Three normal = {s.nx[v], s.ny[v], s.nz[v]}, u = {row.by[0][n], row.by[1][n], row.by[2][n]};
      const float whole = 1.0f - s.torn[v], per_width = 1.0f / s.width[v], area = s.area[v];
      const float along = u.x * normal.x + u.y * normal.y + u.z * normal.z;

      // Fibres: opening and shear, pulled along the rise of both.
      const float opening = along < 0.0f ? 1.0f : 0.0f, extra = opening - law.shear;
      const Three pull = {law.shear * u.x + extra * along * normal.x, law.shear * u.y + extra * along * normal.y,
                          law.shear * u.z + extra * along * normal.z};
      const float way = __builtin_sqrtf(greater(pull.x * u.x + pull.y * u.y + pull.z * u.z, 1e-12f));
      const float per_way = 1.0f / way;
      const Stressed fibre = fibresAt(law, way * per_width);
      const Three m = {pull.x * per_way, pull.y * per_way, pull.z * per_way};
      const float tension = area * whole * fibre.stress, secant = tension * per_way;
      const float all = law.shear * secant, bend = area * whole * fibre.slope * per_width - secant;

      // Fluid: a Maxwell branch along the normal.
      const float kept = law.fluid_kept * whole, strained = along * per_width - s.strain[v];
      const float flow = area * (s.fluid[v] + law.fluid * strained) * kept;
      const float fluid_energy = (s.fluid[v] + 0.5f * law.fluid * strained) * strained * kept;
      const float normal_stiffness = extra * secant + area * law.fluid * kept * per_width;

      // Wall: what closes between root and bone.
      const Three in = kHasField ? Three{row.in[0][n], row.in[1][n], row.in[2][n]} : normal;
      const float depth = (kHasField ? s.rest_gap[v] - row.gap[n] : along) - s.widened[v];
      const Stressed wall = wallAt(law, depth * per_width);
      const float pressure = area * wall.stress, wall_stiffness = area * wall.slope * per_width;

      const Three f = {tension * m.x + flow * normal.x + pressure * in.x,
                       tension * m.y + flow * normal.y + pressure * in.y,
                       tension * m.z + flow * normal.z + pressure * in.z};
      const Three a = {normal_stiffness * normal.x, normal_stiffness * normal.y, normal_stiffness * normal.z};
      const Three b = {bend * m.x, bend * m.y, bend * m.z};
      const Three c = {wall_stiffness * in.x, wall_stiffness * in.y, wall_stiffness * in.z};
      const Stiffness k = {
          all + a.x * normal.x + b.x * m.x + c.x * in.x, a.x * normal.y + b.x * m.y + c.x * in.y,
          a.x * normal.z + b.x * m.z + c.x * in.z,       all + a.y * normal.y + b.y * m.y + c.y * in.y,
          a.y * normal.z + b.y * m.z + c.y * in.z,       all + a.z * normal.z + b.z * m.z + c.z * in.z};
      addSample(lane, n, {row.arm[0][n], row.arm[1][n], row.arm[2][n]}, f, k,
                area * s.width[v] * (whole * fibre.energy + fluid_energy + wall.energy));
    }
  }
  addLanes(lane, sums);
}

void sumContact(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& where, HoldSums& sums) {
  const HoldSamples s = samples;
  const HoldPlace place = where;
  const float clear = 0.87f / place.per_mm, contact = law.contact;
  alignas(64) float lane[kTerms][kLanes] = {};
  alignas(64) Row row;
  for (int first = s.ligament; first < s.all; first += kLanes) {
    place16(s, place, first, row);
    // Most samples are clear of everything: the nearest voxel tells.
    int close = 0;
    for (int n = 0; n < kLanes; ++n) {
      const float rough = roughGap(place, {row.arm[0][n], row.arm[1][n], row.arm[2][n]});
      close += rough < s.rest_gap[first + n] + clear ? 1 : 0;
    }
    if (close == 0) continue;
    lookAround(place, row);
    for (int n = 0; n < kLanes; ++n) {
      const Three in = {row.in[0][n], row.in[1][n], row.in[2][n]};
      const float depth = greater(s.rest_gap[first + n] - row.gap[n], 0.0f);
      const float stiff = (depth > 0.0f ? contact : 0.0f) * s.area[first + n], push = stiff * depth;
      const Three c = {stiff * in.x, stiff * in.y, stiff * in.z};
      addSample(lane, n, {row.arm[0][n], row.arm[1][n], row.arm[2][n]}, {push * in.x, push * in.y, push * in.z},
                {c.x * in.x, c.x * in.y, c.x * in.z, c.y * in.y, c.y * in.z, c.z * in.z}, 0.5f * push * depth);
    }
  }
  const double before = sums.energy;
  addLanes(lane, sums);
  sums.contact_energy = sums.energy - before;
}

/// What sixteen samples remember, and what they add to the sums.
struct RowAge {
  float torn[kLanes], fluid[kLanes], strain[kLanes], widened[kLanes];
  float torn_Nmm[kLanes], stored_Nmm[kLanes], torn_area[kLanes];
};

template <bool kHasField>
void ageRow(const HoldConstants& law, const HoldSamples& s, int first, const Row& row, RowAge& __restrict age) {
  const float per_peak = 1.0f / law.peak_stress, per_fluid = law.fluid > 0.0f ? 0.5f / law.fluid : 0.0f;
  const float* __restrict nx = s.nx + first, * __restrict ny = s.ny + first, * __restrict nz = s.nz + first;
  const float* __restrict areas = s.area + first, * __restrict widths = s.width + first;
  const float* __restrict rest_gap = s.rest_gap + first;
  const float creep = law.creep, creep_floor = law.creep_floor;
  for (int n = 0; n < kLanes; ++n) {
    const float x = row.by[0][n], y = row.by[1][n], z = row.by[2][n];
    const float per_width = 1.0f / widths[n], area = areas[n], volume = area * widths[n];
    const float along = x * nx[n] + y * ny[n] + z * nz[n], open = lesser(along, 0.0f);
    const float across2 = x * x + y * y + z * z - along * along;
    const float stretch = __builtin_sqrtf(greater(law.shear * across2 + open * open, 0.0f)) * per_width;

    // Torn by stretch beyond the peak, or in time below it.
    const Stressed fibre = fibresAt(law, stretch);
    const float load = fibre.stress * per_peak, load2 = load * load;
    const float crept = (load > creep_floor ? creep : 0.0f) * (load2 * load2 * load2);
    const float before = age.torn[n];
    const float after = lesser(greater(before, (stretch - law.peak_stretch) * law.per_softening) + crept, 1.0f);
    age.torn_Nmm[n] += volume * fibre.energy * (after - before);
    age.torn_area[n] += area * after;
    age.torn[n] = after;

    const float strain = along * per_width;
    const float fluid = (age.fluid[n] + law.fluid * (strain - age.strain[n])) * law.fluid_kept * (1.0f - before);
    age.fluid[n] = fluid;
    age.strain[n] = strain;

    const float depth = (kHasField ? rest_gap[n] - row.gap[n] : along) - age.widened[n];
    const Stressed wall = wallAt(law, depth * per_width);
    age.widened[n] += law.widening * greater(wall.stress - law.yield, 0.0f);
    age.stored_Nmm[n] += volume * ((1.0f - after) * fibre.energy + wall.energy + per_fluid * fluid * fluid);
  }
}

template <bool kHasField>
HoldAge ageLigament(const HoldConstants& law, const HoldSamples& s, const HoldPlace& place, const HoldMemory& memory) {
  alignas(64) Row row;
  alignas(64) RowAge age{};
  for (int first = 0; first < s.ligament; first += kLanes) {
    place16(s, place, first, row);
    if constexpr (kHasField) lookAround(place, row);
    for (int n = 0; n < kLanes; ++n) age.torn[n] = memory.torn[first + n];
    for (int n = 0; n < kLanes; ++n) age.fluid[n] = memory.fluid[first + n];
    for (int n = 0; n < kLanes; ++n) age.strain[n] = memory.strain[first + n];
    for (int n = 0; n < kLanes; ++n) age.widened[n] = memory.widened[first + n];
    ageRow<kHasField>(law, s, first, row, age);
    for (int n = 0; n < kLanes; ++n) memory.torn[first + n] = age.torn[n];
    for (int n = 0; n < kLanes; ++n) memory.fluid[first + n] = age.fluid[n];
    for (int n = 0; n < kLanes; ++n) memory.strain[first + n] = age.strain[n];
    for (int n = 0; n < kLanes; ++n) memory.widened[first + n] = age.widened[n];
  }
  HoldAge sums{};
  for (int n = 0; n < kLanes; ++n) {
    sums.torn_Nmm += static_cast<double>(age.torn_Nmm[n]);
    sums.stored_Nmm += static_cast<double>(age.stored_Nmm[n]);
    sums.torn_area_mm2 += static_cast<double>(age.torn_area[n]);
  }
  return sums;
}

}  // namespace

namespace MOLAR_KERNEL_SET {

HoldSums sumHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place) noexcept {
  HoldSums sums{};
  if (place.distance == nullptr) {
    sumLigament<false>(law, samples, place, sums);
  } else {
    sumLigament<true>(law, samples, place, sums);
    sumContact(law, samples, place, sums);
  }
  return sums;
}

HoldAge ageHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place,
                const HoldMemory& memory) noexcept {
  return place.distance == nullptr ? ageLigament<false>(law, samples, place, memory)
                                   : ageLigament<true>(law, samples, place, memory);
}

}  // namespace MOLAR_KERNEL_SET
}  // namespace haptics
