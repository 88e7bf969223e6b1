// Samples of a piece against an elevator's blade, sixteen lanes at a time: which are near, and how far each is from the
// surface. Coordinates u, v, s: the outline's plane and across it, see ElevatorShape. Plain values, one set of
// functions per instruction set and the same bits from all: floats without fused multiply-add. Servo thread; no
// allocation; 1 µs for the near ones of 2000, 1 µs for the gaps of 200. Private to ligament/.
#pragma once

#include <cstdint>

namespace haptics {

/// Edge n runs from corner n along `along`; `out` is normal to it, `offset` its place along that.
struct BladeOutline {
  float corner[4][2], along[4][2], out[4][2], offset[4], per_length2[4];
  float half, edge_radius;
  int shaft;  ///< the coordinate along the shaft: 0 u, 1 v
  float shank_radius, shank_from, shank_to;
  float middle[3], reach;
};

/// From samples, about their centre, to u, v, s: rows of a rotation, then a way.
struct BladePlace {
  float turn[9], shift[3];
};

/// Structure of arrays; `count` is a multiple of sixteen.
struct BladeSamples {
  const float *x, *y, *z;
  int count;
};

struct BladeGaps {
  float *gap, *out_u, *out_v, *out_s;
};

/// Indices of samples in the ball about the blade or around the shank, `within` of them; at most `most`, the first.
int nearBlade(const BladeOutline& blade, const BladePlace& place, const BladeSamples& samples, float within,
              std::uint16_t* index, int most) noexcept;
void bladeGaps(const BladeOutline& blade, const BladePlace& place, const BladeSamples& samples,
               const BladeGaps& gaps) noexcept;

#define MOLAR_BLADE_KERNELS(SET)                                                                               \
  namespace SET {                                                                                              \
  int nearBlade(const BladeOutline& blade, const BladePlace& place, const BladeSamples& samples, float within, \
                std::uint16_t* index, int most) noexcept;                                                      \
  void bladeGaps(const BladeOutline& blade, const BladePlace& place, const BladeSamples& samples,              \
                 const BladeGaps& gaps) noexcept;                                                              \
  }
MOLAR_BLADE_KERNELS(portable)
#if defined(__x86_64__)
MOLAR_BLADE_KERNELS(avx2)
MOLAR_BLADE_KERNELS(avx512)
#endif
#undef MOLAR_BLADE_KERNELS

}  // namespace haptics
