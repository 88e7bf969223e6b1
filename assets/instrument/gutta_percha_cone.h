// Cones of gutta-percha for root fillings as ISO 6877 names them: the size is the diameter of the tip in 1/100 mm, the
// taper is how much it grows a millimetre. Pliers hold a cone by what lies at the tooth's reference, so its length is
// that from its tip to the pliers, not the 28 mm that are sold. Nominal: made cones are up to 0.05 mm off (unverified).
// mm. Plain values; any thread.
#pragma once

#include <array>
#include <cmath>
#include <optional>

namespace assets {

inline constexpr std::array kConeTapers{0.02, 0.04, 0.06};
inline constexpr int kThinnestCone = 15, kThickestCone = 60, kConeStep = 5;
inline constexpr double kShortestCone_mm = 10.0, kLongestCone_mm = 28.0;

struct GuttaPerchaCone {
  int size = 25;
  double taper = 0.02;  ///< mm a mm
  double length_mm = 21.0;

  double diameter_mm(double from_tip_mm) const { return 0.01 * size + taper * (from_tip_mm > 0.0 ? from_tip_mm : 0.0); }
};

/// None: no such cone is made. The servo's thread comes here too.
inline std::optional<GuttaPerchaCone> guttaPerchaCone(int size, double taper, double length_mm) {
  if (size < kThinnestCone || size > kThickestCone || size % kConeStep != 0) return std::nullopt;
  if (!(length_mm >= kShortestCone_mm && length_mm <= kLongestCone_mm)) return std::nullopt;
  constexpr double kSame = 1e-6;
  for (const double made : {0.02, 0.04, 0.06})
    if (std::fabs(made - taper) < kSame) return GuttaPerchaCone{size, made, length_mm};
  return std::nullopt;
}

}  // namespace assets
