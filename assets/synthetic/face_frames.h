// The two bodies of the synthetic head with the mouth open.
// Mandible: frame P (LPS mm, origin between the lower incisal edges), mirrored in x for a right-sided operation, so
// that the operated side is at +x. Skull K: same axes and origin with the mouth closed. Opening: 22 degrees about a
// hinge near the condyles and 10 mm forward glide, interincisal distance about 37 mm (norm 35-50 mm; Gray's Anatomy).
// Any thread; a few flops.
#pragma once

#include "assets/synthetic/implicit_shape.h"
#include "calibration/geometry/units.h"

namespace assets {

inline constexpr double kOpening_rad = 22.0 * calibration::kPi / 180.0;
inline constexpr glm::dvec3 kHinge_K_mm{0.0, 88.0, 48.0};
inline constexpr glm::dvec3 kGlide_K_mm{0.0, -10.0, -4.0};

inline glm::dvec3 skullFromMandible(const glm::dvec3& p_P) {
  return kHinge_K_mm + rotatedAboutX(p_P - kHinge_K_mm, kOpening_rad) + kGlide_K_mm;
}

inline glm::dvec3 mandibleFromSkull(const glm::dvec3& p_K) {
  return kHinge_K_mm + rotatedAboutX(p_K - kGlide_K_mm - kHinge_K_mm, -kOpening_rad);
}

}  // namespace assets
