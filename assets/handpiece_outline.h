// Outline of the surgical handpiece as drawn (instrument/handpiece): radius over z of frame T, mm, so that what touches
// soft tissue is what is seen. The drawn body lies inside it, by at most 0.6 mm. Plain data; any thread.
#pragma once

#include <array>

namespace assets {

struct OutlineRing {
  double z_mm, radius_mm;
};

/// From the nose, where the shank leaves it, to the coupling; linear in between.
inline constexpr std::array<OutlineRing, 9> kHandpieceOutline = {{{20.0, 2.3},
                                                                  {20.6, 2.35},
                                                                  {30.0, 3.6},
                                                                  {38.0, 4.7},
                                                                  {41.6, 6.25},
                                                                  {66.3, 6.6},
                                                                  {72.0, 8.2},
                                                                  {102.5, 8.8},
                                                                  {110.0, 8.8}}};

/// Radius at z; 0 in front of the nose and behind the coupling.
constexpr double handpieceRadius_mm(double z_mm) {
  if (z_mm < kHandpieceOutline.front().z_mm || z_mm > kHandpieceOutline.back().z_mm) return 0.0;
  for (std::size_t n = 1; n < kHandpieceOutline.size(); ++n) {
    const OutlineRing &from = kHandpieceOutline[n - 1], &to = kHandpieceOutline[n];
    if (z_mm <= to.z_mm)
      return from.radius_mm + (to.radius_mm - from.radius_mm) * (z_mm - from.z_mm) / (to.z_mm - from.z_mm);
  }
  return kHandpieceOutline.back().radius_mm;
}

}  // namespace assets
