// SIMD vocabulary of the CPU kernels: kLanes floats or integers per instruction. A kernel source is written once and
// compiled for each instruction set with the flags of render/CMakeLists.txt: 4 lanes portable, 8 AVX2, 16 AVX-512.
// Internal linkage throughout, so that no code of one set is linked into another: include only in kernel sources.
// Float and Int are GCC vectors: + - * / & | ^ ~ << >> and comparisons work, also with a scalar on one side.
// A Mask is an Int of -1 (yes) and 0 (no), the result of comparisons; combined with &, ~ and select().
// squareRoot and division are IEEE, so the sets agree bit for bit except for multiplyAdd (fused where available).
// Gathers read only the lanes of their mask.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace render::cpu {
namespace {

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define KERNEL_SET avx512
constexpr int kLanes = 16;
#elif defined(__AVX2__) && defined(__FMA__)
#define KERNEL_SET avx2
constexpr int kLanes = 8;
#else
#define KERNEL_SET portable
constexpr int kLanes = 4;
#endif

using Float = float __attribute__((vector_size(4 * kLanes)));
using Int = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Word = std::uint32_t __attribute__((vector_size(4 * kLanes)));
using Mask = Int;

/// 64 bits per lane, in two halves.
struct IntPair {
  Int low, high;
};

inline Float splat(float value) { return value - Float{}; }
inline Int splat(int value) { return value - Int{}; }

inline Float load(const float* from) {
  Float value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
inline Int load(const std::int32_t* from) {
  Int value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
inline void store(float* to, Float value) { std::memcpy(to, &value, sizeof value); }
inline void store(std::int32_t* to, Int value) { std::memcpy(to, &value, sizeof value); }

/// The same bits as the other type.
inline Int bitsOf(Float value) { return reinterpret_cast<Int>(value); }
inline Float floatOfBits(Int bits) { return reinterpret_cast<Float>(bits); }

inline Float toFloat(Int value) { return __builtin_convertvector(value, Float); }
/// Towards zero.
inline Int toInt(Float value) { return __builtin_convertvector(value, Int); }
inline Int shiftRightLogical(Int value, int by) { return reinterpret_cast<Int>(reinterpret_cast<Word>(value) >> by); }

/// 0, 1, 2 … per lane.
inline Int laneNumbers() {
  Int number{};
  for (int n = 0; n < kLanes; ++n) number[n] = n;
  return number;
}
/// An element of an array of bytes, however aligned.
template <class T, int kScale>
inline T element(const void* base, std::int32_t index) {
  T value;
  std::memcpy(&value, static_cast<const char*>(base) + static_cast<std::ptrdiff_t>(index) * kScale, sizeof value);
  return value;
}
inline Mask everyLane() { return ~Int{}; }
/// The first `count` lanes.
inline Mask firstLanes(int count) { return laneNumbers() < count; }

}  // namespace
}  // namespace render::cpu

// minimum, maximum, floor, ceiling, squareRoot, multiplyAdd, select, bits, pairSums, compress and gathers.
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "render/cpu/lanes_avx512.h"
#elif defined(__AVX2__) && defined(__FMA__)
#include "render/cpu/lanes_avx2.h"
#else
#include "render/cpu/lanes_portable.h"
#endif

namespace render::cpu {
namespace {

inline int compress(float* to, Float value, Mask mask) {
  return compress(reinterpret_cast<std::int32_t*>(to), bitsOf(value), mask);
}
inline bool any(Mask mask) { return bits(mask) != 0; }
inline bool none(Mask mask) { return bits(mask) == 0; }

inline Float select(Mask mask, Float yes, float no) { return select(mask, yes, splat(no)); }
inline Float minimum(Float a, float b) { return minimum(a, splat(b)); }
inline Float maximum(Float a, float b) { return maximum(a, splat(b)); }
inline Int clamp(Int value, Int low, Int high) { return minimum(maximum(value, low), high); }
inline Int clamp(Int value, int low, int high) { return clamp(value, splat(low), splat(high)); }
inline Float clamp(Float value, Float low, Float high) { return minimum(maximum(value, low), high); }
inline Float clamp(Float value, float low, float high) { return clamp(value, splat(low), splat(high)); }
inline Float absolute(Float value) { return floatOfBits(bitsOf(value) & 0x7fffffff); }
inline Float inverseSquareRoot(Float value) { return 1.0f / squareRoot(value); }
inline Float mix(Float from, Float to, Float part) { return multiplyAdd(part, to - from, from); }
/// GLSL's.
inline Float smoothStep(float low, float high, Float value) {
  const Float t = clamp((value - low) * (1.0f / (high - low)), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// 2^value, relative error 2e-7; clamped to -126 … 126. Taylor series about the nearest integer, truncation error
/// (ln(2)/2)^8 / 8! = 5e-9.
inline Float exp2(Float value) {
  const Float x = clamp(value, -126.0f, 126.0f), whole = floor(x + 0.5f), f = x - whole;
  constexpr float kTerms[] = {
      1.540353039e-4f, 1.333355815e-3f, 9.618129108e-3f, 5.550410866e-2f, 2.402265070e-1f, 6.931471806e-1f, 1.0f};
  Float sum = splat(1.525273380e-5f);
  for (const float term : kTerms) sum = multiplyAdd(sum, f, splat(term));
  return sum * floatOfBits((toInt(whole) + 127) << 23);
}

/// Element `index` of an array in lanes of the mask, zero elsewhere. Indices count elements, so arrays may exceed 2 GB.
inline Int gather(const std::uint8_t* array, Int index, Mask mask) { return gatherNarrow(array, index & mask) & mask; }
inline Int gather(const std::uint16_t* array, Int index, Mask mask) { return gatherNarrow(array, index & mask) & mask; }
inline Int gather(const std::int32_t* array, Int index, Mask mask) { return gather32<4>(array, index & mask) & mask; }
inline Int gather(const std::uint32_t* array, Int index, Mask mask) { return gather32<4>(array, index & mask) & mask; }
inline Float gather(const float* array, Int index, Mask mask) {
  return floatOfBits(gather32<4>(array, index & mask) & mask);
}

}  // namespace
}  // namespace render::cpu
