// A number for a number, as if by chance and the same everywhere: SplitMix64 (Steele, Lea, Flood, OOPSLA 2014). Any
// thread. Not for secrets.
#pragma once

#include <cstdint>

namespace calibration {

/// What each step of the sequence adds.
inline constexpr std::uint64_t kMixedStep = 0x9e3779b97f4a7c15ull;

/// Its finaliser: a bijection that spreads every bit.
constexpr std::uint64_t mixedBits(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace calibration
