// The opening of a suction tip, and what it takes: loose things within reach and not behind bone. With water they float
// and come from kRinsed_mm away at kRinse_mm_per_s, without from kDry_mm. Our defaults (reference/extraction 9: 4 mm, 2
// mm/s for each mL/s; 4 mL/s of a syringe). Frame P, mm. Pure.
#pragma once

#include <algorithm>

#include <glm/glm.hpp>

namespace app {

inline constexpr double kRinsed_mm = 4.0, kDry_mm = 1.5, kRinse_mm_per_s = 8.0, kOpening_mm = 1.0;

struct SuctionTip {
  glm::dvec3 at_P_mm{0.0};
  bool has_water = false;

  double reach_mm() const { return has_water ? kRinsed_mm : kDry_mm; }
};

/// How a thing at `p_P_mm` moves in `dt_s`, if no bone is between: is_free(point). True: it has reached the opening.
template <class IsFree>
bool drawTowards(const SuctionTip& tip, double radius_mm, double dt_s, const IsFree& is_free, glm::dvec3& p_P_mm) {
  const glm::dvec3 way = tip.at_P_mm - p_P_mm;
  const double distance_mm = glm::length(way);
  if (distance_mm > tip.reach_mm() + radius_mm) return false;
  if (distance_mm <= kOpening_mm + radius_mm) return true;
  constexpr double kLook_mm = 0.25;
  for (double mm = radius_mm; mm < distance_mm - kOpening_mm; mm += kLook_mm)
    if (!is_free(p_P_mm + way * (mm / distance_mm))) return false;
  p_P_mm += way * (std::min(kRinse_mm_per_s * dt_s, distance_mm) / distance_mm);
  return false;
}

}  // namespace app
