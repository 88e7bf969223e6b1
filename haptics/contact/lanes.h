// Sixteen floats in one, two or four registers, by the instruction set the compiler targets. For kernels compiled once
// per instruction set: internal linkage throughout, so that no copy for a newer machine is linked where an older one
// runs. AVX2 and AVX-512 round alike, so the bits are the same; the portable version has no fused multiply-add and
// differs in the last place. Include in kernels only, after <immintrin.h> where there is AVX2.
#pragma once

#include <cstdint>

namespace haptics {
namespace {

#if defined(__AVX512F__)

struct Lanes {
  __m512 v;
};
inline Lanes all(float x) { return {_mm512_set1_ps(x)}; }
inline Lanes load(const float* x) { return {_mm512_loadu_ps(x)}; }
inline Lanes load(const std::uint8_t* x) {
  const void* const bytes = x;
  return {_mm512_cvtepi32_ps(_mm512_cvtepu8_epi32(_mm_loadu_si128(static_cast<const __m128i*>(bytes))))};
}
inline void store(float* out, Lanes a) { _mm512_storeu_ps(out, a.v); }
inline Lanes operator+(Lanes a, Lanes b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Lanes timesPlus(Lanes a, Lanes b, Lanes c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
inline Lanes clamped(Lanes a, Lanes low, Lanes high) { return {_mm512_min_ps(_mm512_max_ps(a.v, low.v), high.v)}; }

#elif defined(__AVX2__)

struct Lanes {
  __m256 v[2];
};
inline Lanes all(float x) { return {{_mm256_set1_ps(x), _mm256_set1_ps(x)}}; }
inline Lanes load(const float* x) { return {{_mm256_loadu_ps(x), _mm256_loadu_ps(x + 8)}}; }
inline Lanes load(const std::uint8_t* x) {
  const __m128i bytes = _mm_loadu_si128(static_cast<const __m128i*>(static_cast<const void*>(x)));
  return {{_mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(bytes)),
           _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_srli_si128(bytes, 8)))}};
}
inline void store(float* out, Lanes a) { _mm256_storeu_ps(out, a.v[0]), _mm256_storeu_ps(out + 8, a.v[1]); }
inline Lanes operator+(Lanes a, Lanes b) { return {{_mm256_add_ps(a.v[0], b.v[0]), _mm256_add_ps(a.v[1], b.v[1])}}; }
inline Lanes operator-(Lanes a, Lanes b) { return {{_mm256_sub_ps(a.v[0], b.v[0]), _mm256_sub_ps(a.v[1], b.v[1])}}; }
inline Lanes operator*(Lanes a, Lanes b) { return {{_mm256_mul_ps(a.v[0], b.v[0]), _mm256_mul_ps(a.v[1], b.v[1])}}; }
inline Lanes timesPlus(Lanes a, Lanes b, Lanes c) {
  return {{_mm256_fmadd_ps(a.v[0], b.v[0], c.v[0]), _mm256_fmadd_ps(a.v[1], b.v[1], c.v[1])}};
}
inline Lanes clamped(Lanes a, Lanes low, Lanes high) {
  return {{_mm256_min_ps(_mm256_max_ps(a.v[0], low.v[0]), high.v[0]),
           _mm256_min_ps(_mm256_max_ps(a.v[1], low.v[1]), high.v[1])}};
}

#else

// The compiler's four-float vectors: SSE2 on x86-64.
using Four = float __attribute__((vector_size(16)));
struct Lanes {
  Four v[4];
};
template <class Each>
inline Lanes eachFour(Each each) {
  return {{each(0), each(1), each(2), each(3)}};
}
inline Lanes all(float x) {
  return eachFour([=](int) { return Four{x, x, x, x}; });
}
inline Lanes load(const float* x) {
  return eachFour([=](int n) { return Four{x[4 * n], x[4 * n + 1], x[4 * n + 2], x[4 * n + 3]}; });
}
inline Lanes load(const std::uint8_t* x) {
  return eachFour([=](int n) {
    return Four{static_cast<float>(x[4 * n]), static_cast<float>(x[4 * n + 1]), static_cast<float>(x[4 * n + 2]),
                static_cast<float>(x[4 * n + 3])};
  });
}
inline void store(float* out, const Lanes& a) {
  for (int n = 0; n < 16; ++n) out[n] = a.v[n / 4][n % 4];
}
inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return eachFour([&](int n) { return a.v[n] + b.v[n]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return eachFour([&](int n) { return a.v[n] - b.v[n]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return eachFour([&](int n) { return a.v[n] * b.v[n]; });
}
inline Lanes timesPlus(const Lanes& a, const Lanes& b, const Lanes& c) { return a * b + c; }
inline Lanes clamped(const Lanes& a, const Lanes& low, const Lanes& high) {
  return eachFour([&](int n) {
    const Four least = a.v[n] > low.v[n] ? a.v[n] : low.v[n];
    return least < high.v[n] ? least : high.v[n];
  });
}

#endif

/// In a fixed order.
inline double sumOf(const Lanes& a) {
  float lane[16];
  store(lane, a);
  double sum = 0.0;
  for (float x : lane) sum += static_cast<double>(x);
  return sum;
}

}  // namespace
}  // namespace haptics
