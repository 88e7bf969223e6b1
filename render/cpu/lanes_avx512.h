// Operations that GCC's vectors lack, with AVX-512 F, BW, DQ and VL. Included by lanes.h only.
#pragma once

#include <immintrin.h>

namespace render::cpu {
namespace {

inline Float minimum(Float a, Float b) { return _mm512_min_ps(a, b); }
inline Float maximum(Float a, Float b) { return _mm512_max_ps(a, b); }
inline Int minimum(Int a, Int b) { return Int(_mm512_min_epi32(__m512i(a), __m512i(b))); }
inline Int maximum(Int a, Int b) { return Int(_mm512_max_epi32(__m512i(a), __m512i(b))); }
inline Float floor(Float value) { return _mm512_roundscale_ps(value, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
inline Float ceiling(Float value) { return _mm512_roundscale_ps(value, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC); }
inline Float squareRoot(Float value) { return _mm512_sqrt_ps(value); }
/// a · b + c
inline Float multiplyAdd(Float a, Float b, Float c) { return _mm512_fmadd_ps(a, b, c); }
inline unsigned bits(Mask mask) { return _mm512_movepi32_mask(__m512i(mask)); }
inline Float select(Mask mask, Float yes, Float no) {
  return _mm512_mask_blend_ps(static_cast<__mmask16>(bits(mask)), no, yes);
}
inline Int select(Mask mask, Int yes, Int no) {
  return Int(_mm512_mask_blend_epi32(static_cast<__mmask16>(bits(mask)), __m512i(no), __m512i(yes)));
}
/// Lanes as pairs of signed 16 bits: low · low + high · high.
inline Int pairSums(Int a, Int b) { return Int(_mm512_madd_epi16(__m512i(a), __m512i(b))); }

/// Writes the values of the mask's lanes contiguously, followed by undefined ones up to kLanes; returns their number.
inline int compress(std::int32_t* to, Int value, Mask mask) {
  const unsigned chosen = bits(mask);
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(chosen), __m512i(value)));
  return __builtin_popcount(chosen);
}

/// 32 bits at `index` times kScale bytes from the base, however aligned.
template <int kScale>
inline Int gather32(const void* base, Int index) {
  return Int(_mm512_i32gather_epi32(__m512i(index), base, kScale));
}
/// 64 bits, likewise.
template <int kScale>
inline IntPair gather64(const void* base, Int index) {
  const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(__m512i(index)), base, kScale);
  const __m512i high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(__m512i(index), 1), base, kScale);
  const __m512i even = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
  const __m512i odd = _mm512_set_epi32(31, 29, 27, 25, 23, 21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 1);
  return {Int(_mm512_permutex2var_epi32(low, even, high)), Int(_mm512_permutex2var_epi32(low, odd, high))};
}
/// 8 or 16 bits each, one by one: a 32-bit gather would read beyond the end of the array.
template <class T>
inline Int gatherNarrow(const T* base, Int index) {
  alignas(64) std::int32_t i[kLanes], value[kLanes];
  store(i, index);
  for (int n = 0; n < kLanes; ++n) value[n] = base[i[n]];
  return load(value);
}

}  // namespace
}  // namespace render::cpu
