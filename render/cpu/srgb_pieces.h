// The sRGB curve (IEC 61966-2-1) as line segments over eighths of octaves, from 2^-9 to 1, and its linear part below.
// Error at most 0.06/255. Plain numbers, any thread.
#pragma once

#include <cstdint>

namespace render {

inline constexpr std::int32_t kSrgbFirstBits = (127 - 9) << 23;  ///< of the float 2^-9
inline constexpr int kSrgbPieceShift = 20;                       ///< leaves exponent and three bits of the fraction
inline constexpr int kSrgbPieces = 9 * 8;
inline constexpr std::int32_t kSrgbLastBits = (kSrgbPieces << kSrgbPieceShift) - 1;
inline constexpr float kSrgbLinearEnd = 0.0031308f;

/// 0..255 at the start of each piece, and the rise to its end.
struct SrgbPieces {
  float low[kSrgbPieces], rise[kSrgbPieces];
};
extern const SrgbPieces kSrgbTable;

}  // namespace render
