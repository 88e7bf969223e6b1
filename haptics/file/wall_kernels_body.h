// The rays' kernel, included once by each instruction set's source, which defines MOLAR_KERNEL_SET and, for AVX,
// includes <immintrin.h> first. Vectors of the compiler as wide as the set's registers; only gathers name instructions.
// A row of four voxels is one word of the block, so the three bytes along i lie in two words at most.
#pragma once

#include <cstring>

#include "haptics/file/wall_kernels.h"

namespace haptics {
namespace {

#if defined(__AVX512F__)
constexpr int kWide = 16;
#elif defined(__AVX2__)
constexpr int kWide = 8;
#else
constexpr int kWide = 4;
#endif
using Floats = float __attribute__((vector_size(4 * kWide)));
using Ints = int __attribute__((vector_size(4 * kWide)));
using Words = std::uint32_t __attribute__((vector_size(4 * kWide)));

inline Floats spread(float x) { return Floats{} + x; }
inline Floats loaded(const float* from) {
  Floats v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void kept(const Floats& v, float* to) { std::memcpy(to, &v, sizeof v); }

inline void gather(const std::uint8_t* bytes, const Ints& word, Words& out) {
#if defined(__AVX512F__)
  out = reinterpret_cast<Words>(_mm512_i32gather_epi32(reinterpret_cast<__m512i>(word), bytes, 4));
#elif defined(__AVX2__)
  const void* const from = bytes;
  out = reinterpret_cast<Words>(
      _mm256_i32gather_epi32(static_cast<const int*>(from), reinterpret_cast<__m256i>(word), 4));
#else
  for (int n = 0; n < kWide; ++n) {
    std::uint32_t one;
    std::memcpy(&one, bytes + 4 * static_cast<std::size_t>(word[n]), 4);
    out[n] = one;
  }
#endif
}

/// Of two neighbours in memory, by one load each.
inline void gatherPairs(const std::uint32_t* from, const Ints& index, Words& here, Words& next) {
#if defined(__AVX512F__)
  const __m512i at = reinterpret_cast<__m512i>(index);
  const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(at), from, 4),
                high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(at, 1), from, 4);
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  here = reinterpret_cast<Words>(_mm512_permutex2var_epi32(low, even, high));
  next = reinterpret_cast<Words>(_mm512_permutex2var_epi32(low, _mm512_add_epi32(even, _mm512_set1_epi32(1)), high));
#elif defined(__AVX2__)
  const __m256i at = reinterpret_cast<__m256i>(index);
  const void* const first = from;
  const auto* const pairs = static_cast<const long long*>(first);
  const __m256 low = _mm256_castsi256_ps(_mm256_i32gather_epi64(pairs, _mm256_castsi256_si128(at), 4)),
               high = _mm256_castsi256_ps(_mm256_i32gather_epi64(pairs, _mm256_extracti128_si256(at, 1), 4));
  const __m256i even = _mm256_castps_si256(_mm256_shuffle_ps(low, high, 0x88)),
                odd = _mm256_castps_si256(_mm256_shuffle_ps(low, high, 0xDD));
  here = reinterpret_cast<Words>(_mm256_permute4x64_epi64(even, 0xD8));
  next = reinterpret_cast<Words>(_mm256_permute4x64_epi64(odd, 0xD8));
#else
  for (int n = 0; n < kWide; ++n) here[n] = from[index[n]], next[n] = from[index[n] + 1];
#endif
}

inline bool anyOf(const Ints& mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi32_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask)) != 0;
#elif defined(__AVX2__)
  return _mm256_movemask_epi8(reinterpret_cast<__m256i>(mask)) != 0;
#else
  int any = 0;
  for (int n = 0; n < kWide; ++n) any |= mask[n];
  return any != 0;
#endif
}

/// Weights of the three voxels about a place, and their slopes.
struct Taps {
  Ints nearest;
  Floats w[3], d[3];
};

inline void tapsAt(const Floats& at, int size, Taps& taps) {
  const Floats low = spread(1.0f), high = spread(static_cast<float>(size - 2));
  Floats whole = at + 0.5f;
  whole = whole > low ? whole : low;
  whole = whole < high ? whole : high;
  taps.nearest = __builtin_convertvector(whole, Ints);
  const Floats t = at - __builtin_convertvector(taps.nearest, Floats);
  const Floats before = 0.5f - t, after = 0.5f + t;
  taps.w[0] = 0.5f * before * before;
  taps.w[2] = 0.5f * after * after;
  taps.w[1] = 1.0f - taps.w[0] - taps.w[2];
  taps.d[0] = -before;
  taps.d[1] = -2.0f * t;
  taps.d[2] = after;
}

inline Floats bytesAt(const Words& words, int byte) {
  return __builtin_convertvector(reinterpret_cast<Ints>((words >> (8 * byte)) & 255u), Floats);
}

struct Smooth {
  Floats value, x, y, z, xx, yy, zz, xy, xz, yz;
};

inline Floats weighed(const Floats* weight, const Floats& before, const Floats& at, const Floats& after) {
  return weight[0] * before + weight[1] * at + weight[2] * after;
}
/// The slope of the slopes d: 1 -2 1.
inline Floats bend(const Floats& before, const Floats& at, const Floats& after) { return before - 2.0f * at + after; }

/// The first words of the blocks in which the 3 x 3 rows of voxels about a place begin and end, by k and j: of eight
/// blocks at most, as the outer rows lie in the outer blocks and the middle one in either.
struct RowBlocks {
  Ints first[3][3], last[3][3];
};

inline void rowBlocksAt(const WallVoxels& wall, const Ints& i, const Ints& j, const Ints& k, RowBlocks& out) {
  const Ints first_i = (i - 1) >> 2, is_one = ((i - 1) & 3) < 2;
#pragma GCC unroll 2
  for (int c = 0; c < 3; c += 2)
#pragma GCC unroll 2
    for (int b = 0; b < 3; b += 2) {
      const Ints row = (((k + (c - 1)) >> 2) * wall.blocks[1] + ((j + (b - 1)) >> 2)) * wall.blocks[0];
      Words first, next;
      gatherPairs(wall.slot_of, row + first_i, first, next);
      out.first[c][b] = reinterpret_cast<Ints>(first << 4);
      out.last[c][b] = is_one ? out.first[c][b] : reinterpret_cast<Ints>(next << 4);
    }
  const Ints is_low_j = (j & 3) != 0, is_low_k = (k & 3) != 0;
#pragma GCC unroll 2
  for (int c = 0; c < 3; c += 2) {
    out.first[c][1] = is_low_j ? out.first[c][0] : out.first[c][2];
    out.last[c][1] = is_low_j ? out.last[c][0] : out.last[c][2];
  }
#pragma GCC unroll 3
  for (int b = 0; b < 3; ++b) {
    out.first[1][b] = is_low_k ? out.first[0][b] : out.first[2][b];
    out.last[1][b] = is_low_k ? out.last[0][b] : out.last[2][b];
  }
}

template <bool kIndexed>
inline void smoothAt(const WallVoxels& wall, const Floats& fx, const Floats& fy, const Floats& fz, Smooth& out) {
  Taps i, j, k;
  tapsAt(fx, wall.size[0], i);
  tapsAt(fy, wall.size[1], j);
  tapsAt(fz, wall.size[2], k);
  const Ints first = i.nearest - 1, last = i.nearest + 1;
  const Ints low_word = (first >> 2) * 16, high_word = (last >> 2) * 16;
  const Words shift = reinterpret_cast<Words>((first & 3) * 8);
  const int row = 16 * wall.blocks[0], layer = row * wall.blocks[1];
  RowBlocks blocks;
  if constexpr (kIndexed) rowBlocksAt(wall, i.nearest, j.nearest, k.nearest, blocks);
  Floats value[3], x[3], y[3], xx[3], xy[3], yy[3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const Ints at_k = k.nearest + (c - 1);
    Floats along[3], slope[3], curve[3];
#pragma GCC unroll 3
    for (int b = 0; b < 3; ++b) {
      const Ints at_j = j.nearest + (b - 1), within = (at_k & 3) * 4 + (at_j & 3);
      Words low, high;
      if constexpr (kIndexed) {
        gather(wall.solid, blocks.first[c][b] + within, low);
        gather(wall.solid, blocks.last[c][b] + within, high);
      } else {
        const Ints base = (at_k >> 2) * layer + (at_j >> 2) * row + within;
        gather(wall.solid, base + low_word, low);
        gather(wall.solid, base + high_word, high);
      }
      // Twice, as a shift by all 32 bits is none.
      const Words three = (low >> shift) | ((high << (31u - shift)) << 1);
      const Floats v0 = bytesAt(three, 0), v1 = bytesAt(three, 1), v2 = bytesAt(three, 2);
      along[b] = weighed(i.w, v0, v1, v2);
      slope[b] = weighed(i.d, v0, v1, v2);
      curve[b] = bend(v0, v1, v2);
    }
    value[c] = weighed(j.w, along[0], along[1], along[2]);
    x[c] = weighed(j.w, slope[0], slope[1], slope[2]);
    xx[c] = weighed(j.w, curve[0], curve[1], curve[2]);
    y[c] = weighed(j.d, along[0], along[1], along[2]);
    xy[c] = weighed(j.d, slope[0], slope[1], slope[2]);
    yy[c] = bend(along[0], along[1], along[2]);
  }
  const Floats per = spread(1.0f / 255.0f);
  out.value = per * weighed(k.w, value[0], value[1], value[2]);
  out.x = per * weighed(k.w, x[0], x[1], x[2]);
  out.y = per * weighed(k.w, y[0], y[1], y[2]);
  out.z = per * weighed(k.d, value[0], value[1], value[2]);
  out.xx = per * weighed(k.w, xx[0], xx[1], xx[2]);
  out.yy = per * weighed(k.w, yy[0], yy[1], yy[2]);
  out.zz = per * bend(value[0], value[1], value[2]);
  out.xy = per * weighed(k.w, xy[0], xy[1], xy[2]);
  out.xz = per * weighed(k.d, x[0], x[1], x[2]);
  out.yz = per * weighed(k.d, y[0], y[1], y[2]);
}

inline Ints inside(const Floats& at, int size) {
  return (at > spread(0.0f)) & (at < spread(static_cast<float>(size - 1)));
}

template <bool kIndexed>
inline bool cast(const WallVoxels& wall, const SectionRays& rays, RayDepths& out) {
  bool met = false;
  const Floats none{};
  for (int from = 0; from < kRays; from += kWide) {
    const Floats along_x = loaded(rays.along[0] + from), along_y = loaded(rays.along[1] + from),
                 along_z = loaded(rays.along[2] + from);
    Floats depth = spread(-rays.flat_face), slope[3] = {none, none, none},
           curve[6] = {none, none, none, none, none, none};
    Ints going = none == none;
    float rho = rays.radius;
    for (int n = 0; n < rays.samples && rho >= 0.0f; ++n) {
      const Floats fx = rays.centre[0] + rho * along_x, fy = rays.centre[1] + rho * along_y,
                   fz = rays.centre[2] + rho * along_z;
      Smooth here;
      smoothAt<kIndexed>(wall, fx, fy, fz, here);
      going &= (here.value > none) & inside(fx, wall.size[0]) & inside(fy, wall.size[1]) & inside(fz, wall.size[2]);
      if (!anyOf(going)) break;
      const Floats share = going ? spread(n == 0 ? 0.5f * rays.step : rays.step) : none;
      depth += share * here.value;
      slope[0] += share * here.x;
      slope[1] += share * here.y;
      slope[2] += share * here.z;
      curve[0] += share * here.xx;
      curve[1] += share * here.yy;
      curve[2] += share * here.zz;
      curve[3] += share * here.xy;
      curve[4] += share * here.xz;
      curve[5] += share * here.yz;
      rho -= rays.step;
    }
    met = met || anyOf(depth > none);
    kept(depth, out.depth + from);
    for (int axis = 0; axis < 3; ++axis) kept(slope[axis], out.slope[axis] + from);
    for (int pair = 0; pair < 6; ++pair) kept(curve[pair], out.curve[pair] + from);
  }
  return met;
}

}  // namespace

namespace MOLAR_KERNEL_SET {

bool castRays(const WallVoxels& wall, const SectionRays& rays, RayDepths& out) noexcept {
  return wall.slot_of != nullptr ? cast<true>(wall, rays, out) : cast<false>(wall, rays, out);
}

}  // namespace MOLAR_KERNEL_SET
}  // namespace haptics
