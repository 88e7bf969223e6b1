// Operations that GCC's vectors lack, in plain C++ (SSE2, NEON by the compiler). Included by lanes.h only.
#pragma once

namespace render::cpu {
namespace {

inline Float minimum(Float a, Float b) { return a < b ? a : b; }
inline Float maximum(Float a, Float b) { return a > b ? a : b; }
inline Int minimum(Int a, Int b) { return a < b ? a : b; }
inline Int maximum(Int a, Int b) { return a > b ? a : b; }
inline Float select(Mask mask, Float yes, Float no) { return mask ? yes : no; }
inline Int select(Mask mask, Int yes, Int no) { return mask ? yes : no; }
/// Of values that fit an integer.
inline Float floor(Float value) {
  const Float whole = toFloat(toInt(value));
  return whole - select(whole > value, splat(1.0f), splat(0.0f));
}
inline Float ceiling(Float value) { return -floor(-value); }
inline Float squareRoot(Float value) {
  Float root{};
  for (int n = 0; n < kLanes; ++n) root[n] = __builtin_sqrtf(value[n]);
  return root;
}
/// a · b + c
inline Float multiplyAdd(Float a, Float b, Float c) { return a * b + c; }
/// One bit per lane, the first lowest.
inline unsigned bits(Mask mask) {
  unsigned sum = 0;
  for (int n = 0; n < kLanes; ++n) sum |= (mask[n] != 0 ? 1u : 0u) << n;
  return sum;
}
/// Lanes as pairs of signed 16 bits: low · low + high · high.
inline Int pairSums(Int a, Int b) { return ((a << 16) >> 16) * ((b << 16) >> 16) + (a >> 16) * (b >> 16); }

/// Writes the values of the mask's lanes contiguously, followed by undefined ones up to kLanes; returns their number.
inline int compress(std::int32_t* to, Int value, Mask mask) {
  int count = 0;
  for (int n = 0; n < kLanes; ++n) {
    const std::int32_t lane = value[n];  // copied as bytes, since `to` may point to floats
    if (mask[n] != 0) std::memcpy(to + count++, &lane, sizeof lane);
  }
  return count;
}

/// 8 or 16 bits each.
template <class T>
inline Int gatherNarrow(const T* base, Int index) {
  return Int{base[index[0]], base[index[1]], base[index[2]], base[index[3]]};
}
/// 32 bits at `index` times kScale bytes from the base, however aligned.
template <int kScale>
inline Int gather32(const void* base, Int index) {
  Int value{};
  for (int n = 0; n < kLanes; ++n) value[n] = element<std::int32_t, kScale>(base, index[n]);
  return value;
}
/// 64 bits, likewise.
template <int kScale>
inline IntPair gather64(const void* base, Int index) {
  IntPair pair{};
  for (int n = 0; n < kLanes; ++n) {
    const auto both = element<std::uint64_t, kScale>(base, index[n]);
    pair.low[n] = static_cast<std::int32_t>(static_cast<std::uint32_t>(both));
    pair.high[n] = static_cast<std::int32_t>(static_cast<std::uint32_t>(both >> 32));
  }
  return pair;
}

}  // namespace
}  // namespace render::cpu
