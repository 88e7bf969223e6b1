// Operations that GCC's vectors lack, with AVX2 and FMA. Included by lanes.h only.
// Gathers are loads and inserts: on AMD's Zen 2 and 3 (39 micro-operations for one vpgatherdd) and on Intel processors
// with the 2023 microcode against gather data sampling the instruction itself is slower than eight loads.
#pragma once

#include <immintrin.h>

namespace render::cpu {
namespace {

inline Float minimum(Float a, Float b) { return _mm256_min_ps(a, b); }
inline Float maximum(Float a, Float b) { return _mm256_max_ps(a, b); }
inline Int minimum(Int a, Int b) { return Int(_mm256_min_epi32(__m256i(a), __m256i(b))); }
inline Int maximum(Int a, Int b) { return Int(_mm256_max_epi32(__m256i(a), __m256i(b))); }
inline Float floor(Float value) { return _mm256_floor_ps(value); }
inline Float ceiling(Float value) { return _mm256_ceil_ps(value); }
inline Float squareRoot(Float value) { return _mm256_sqrt_ps(value); }
/// a · b + c
inline Float multiplyAdd(Float a, Float b, Float c) { return _mm256_fmadd_ps(a, b, c); }
inline Float select(Mask mask, Float yes, Float no) { return _mm256_blendv_ps(no, yes, __m256(mask)); }
inline Int select(Mask mask, Int yes, Int no) {
  return Int(_mm256_blendv_epi8(__m256i(no), __m256i(yes), __m256i(mask)));
}
/// One bit per lane, the first lowest.
inline unsigned bits(Mask mask) { return static_cast<unsigned>(_mm256_movemask_ps(__m256(mask))); }
/// Lanes as pairs of signed 16 bits: low · low + high · high.
inline Int pairSums(Int a, Int b) { return Int(_mm256_madd_epi16(__m256i(a), __m256i(b))); }

/// For every mask its lanes in order, a nibble each.
struct LaneOrders {
  std::uint32_t order[256];
  constexpr LaneOrders() : order() {
    for (unsigned mask = 0; mask < 256; ++mask) {
      unsigned position = 0;
      for (unsigned lane = 0; lane < 8; ++lane)
        if ((mask >> lane & 1u) != 0) order[mask] |= lane << (4 * position++);
    }
  }
};
constexpr LaneOrders kLaneOrders;
/// Writes the values of the mask's lanes contiguously, followed by undefined ones up to kLanes; returns their number.
inline int compress(std::int32_t* to, Int value, Mask mask) {
  const unsigned chosen = bits(mask);
  const __m256i nibbles = _mm256_set1_epi32(static_cast<int>(kLaneOrders.order[chosen]));
  const __m256i order = _mm256_srlv_epi32(nibbles, _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28));
  store(to, Int(_mm256_permutevar8x32_epi32(__m256i(value), order)));
  return __builtin_popcount(chosen);
}

/// Stores opaquely to the compiler: eight loads cost less than the extractions it would generate instead.
inline void spill(std::int32_t (&to)[kLanes], Int value) {
  store(to, value);
  asm("" : "+m"(to));
}
template <class T, int kScale>
inline Int gatherAs(const void* base, Int index) {
  alignas(32) std::int32_t i[kLanes];
  spill(i, index);
  const auto at = [&](int n) { return static_cast<int>(element<T, kScale>(base, i[n])); };
  return Int{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
}
/// 8 or 16 bits each.
template <class T>
inline Int gatherNarrow(const T* base, Int index) {
  return gatherAs<T, sizeof(T)>(base, index);
}
/// 32 bits at `index` times kScale bytes from the base, however aligned.
template <int kScale>
inline Int gather32(const void* base, Int index) {
  return gatherAs<std::int32_t, kScale>(base, index);
}
/// 64 bits, likewise.
template <int kScale>
inline IntPair gather64(const void* base, Int index) {
  alignas(32) std::int32_t i[kLanes];
  spill(i, index);
  const auto at = [&](int n) {
    const void* const address = static_cast<const char*>(base) + static_cast<std::ptrdiff_t>(i[n]) * kScale;
    return static_cast<const double*>(address);
  };
  const auto two = [&](int n) { return _mm_loadh_pd(_mm_load_sd(at(n)), at(n + 1)); };
  const __m256 outer = _mm256_castpd_ps(_mm256_set_m128d(two(4), two(0)));
  const __m256 inner = _mm256_castpd_ps(_mm256_set_m128d(two(6), two(2)));
  return {Int(_mm256_shuffle_ps(outer, inner, 0x88)), Int(_mm256_shuffle_ps(outer, inner, 0xdd))};
}

}  // namespace
}  // namespace render::cpu
