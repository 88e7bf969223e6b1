// One sample of a piece's hold: where it is, and what fibres, wall, fluid and contact do there. Included by the kernels
// of each instruction set alone, so internal linkage; no branch that a vectoriser could not turn into a choice.
#pragma once

#include "haptics/ligament/hold_kernels.h"

namespace haptics {
namespace {

inline float lesser(float a, float b) { return a < b ? a : b; }
inline float greater(float a, float b) { return a > b ? a : b; }

/// e^x for 0 <= x <= 80, relative error 2e-6: a power of two times a polynomial.
inline float exponential(float x) {
  const float y = x * 1.44269504f;
  const int whole = static_cast<int>(y);
  const float f = (y - static_cast<float>(whole)) * 0.69314718f;
  const float high = 0.041666667f + f * (0.0083333333f + f * 0.0013888889f);
  const float rest = 1.0f + f * (1.0f + f * (0.5f + f * (0.16666667f + f * high)));
  return rest * __builtin_bit_cast(float, (whole + 127) << 23);
}

struct Three {
  float x, y, z;
};

struct Moved {
  Three arm;  ///< from the centre to the sample
  Three by;   ///< since rest
};

inline Moved movedTo(const HoldPlace& place, Three p) {
  const float* m = place.turn;
  const Three turned = {m[0] * p.x + m[1] * p.y + m[2] * p.z, m[3] * p.x + m[4] * p.y + m[5] * p.z,
                        m[6] * p.x + m[7] * p.y + m[8] * p.z};
  return {{p.x + turned.x, p.y + turned.y, p.z + turned.z},
          {turned.x + place.shift[0], turned.y + place.shift[1], turned.z + place.shift[2]}};
}

/// A place in the field: its cell's first element, and where in the cell it is.
struct InCell {
  int at;
  float x, y, z;
};

inline float withinField(float index, int size) { return lesser(greater(index, 0.0f), static_cast<float>(size - 1)); }

inline InCell cellAt(const HoldPlace& place, Three arm) {
  const float x = withinField(place.centre[0] + place.per_mm * arm.x, place.size[0]);
  const float y = withinField(place.centre[1] + place.per_mm * arm.y, place.size[1]);
  const float z = withinField(place.centre[2] + place.per_mm * arm.z, place.size[2]);
  const int whole_i = static_cast<int>(x), whole_j = static_cast<int>(y), whole_k = static_cast<int>(z);
  const int i = whole_i < place.size[0] - 2 ? whole_i : place.size[0] - 2;
  const int j = whole_j < place.size[1] - 2 ? whole_j : place.size[1] - 2;
  const int k = whole_k < place.size[2] - 2 ? whole_k : place.size[2] - 2;
  return {i + place.size[0] * (j + place.size[1] * k), x - static_cast<float>(i), y - static_cast<float>(j),
          z - static_cast<float>(k)};
}

/// Distance to the obstacles; `in` points into them: minus the slope of the same eight values, i fastest.
struct Nearby {
  float gap;
  Three in;
};

inline Nearby nearbyIn(float per_mm, const InCell& f, float c0, float c1, float c2, float c3, float c4, float c5,
                       float c6, float c7) {
  const float d00 = c1 - c0, d10 = c3 - c2, d01 = c5 - c4, d11 = c7 - c6;
  const float y00 = c0 + f.x * d00, y10 = c2 + f.x * d10, y01 = c4 + f.x * d01, y11 = c6 + f.x * d11;
  const float rise0 = y10 - y00, rise1 = y11 - y01;
  const float z0 = y00 + f.y * rise0, z1 = y01 + f.y * rise1;
  const float dx0 = d00 + f.y * (d10 - d00), dx1 = d01 + f.y * (d11 - d01);
  const float out = -per_mm;
  return {z0 + f.z * (z1 - z0),
          {out * (dx0 + f.z * (dx1 - dx0)), out * (rise0 + f.z * (rise1 - rise0)), out * (z1 - z0)}};
}

/// Of the nearest voxel: within 0.87 voxels of the distance.
inline float roughGap(const HoldPlace& place, Three arm) {
  const int i = static_cast<int>(withinField(place.centre[0] + place.per_mm * arm.x, place.size[0]) + 0.5f);
  const int j = static_cast<int>(withinField(place.centre[1] + place.per_mm * arm.y, place.size[1]) + 0.5f);
  const int k = static_cast<int>(withinField(place.centre[2] + place.per_mm * arm.z, place.size[2]) + 0.5f);
  return place.distance[i + place.size[0] * j + place.size[0] * place.size[1] * k];
}

/// Stress and its slope by stretch, energy by width; of fibres that are whole.
struct Stressed {
  float stress, slope, energy;
};

inline Stressed fibresAt(const HoldConstants& law, float stretch) {
  const float low = lesser(stretch, law.peak_stretch), past = stretch - low;
  const float e = exponential(law.stiffening * low), stress = law.fibre * (e - 1.0f);
  const float to_here = law.fibre * ((e - 1.0f) / law.stiffening - low);
  return {stress, past > 0.0f ? 0.0f : law.fibre * law.stiffening * e, to_here + law.peak_stress * past};
}

inline Stressed wallAt(const HoldConstants& law, float strain) {
  const float pressed = greater(strain, 0.0f), low = lesser(pressed, 1.0f), past = pressed - low;
  const float e = exponential(law.wall_stiffening * low), to_here = law.wall * (e - 1.0f);
  const float slope = past > 0.0f ? law.wall_end_slope : law.wall_slope * e;
  const float energy = law.wall * ((e - 1.0f) / law.wall_stiffening - low);
  return {to_here + law.wall_end_slope * past, strain > 0.0f ? slope : 0.0f,
          energy + past * (law.wall_end + 0.5f * law.wall_end_slope * past)};
}

}  // namespace
}  // namespace haptics
