// What a root filling has come to in one canal (reference/sisters 5.4): its end to the working length, how much of the
// canal as it is prepared it fills from there to the orifice, enclosed air, and what lies beyond the foramen. From the
// tooth as it is and what was laid into it; gutta-percha, sealer and whatever else was laid count alike. Frame P, mm.
// Pure; any thread but the servo's; some 0.2 s a canal at first, less when little has changed.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/procedure/root_canal/air_parts.h"
#include "app/procedure/root_canal/canal_sections.h"
#include "assets/tooth_canals.h"

namespace app {

/// To the working length, from here on a filling is short or long.
inline constexpr double kRightLength_mm = 0.5;

struct RootFilling {
  double end_mm = 0.0;  ///< of its end from the working length; positive: too long
  double canal_mm3 = 0.0, filled_mm3 = 0.0;
  std::vector<EnclosedAir> voids;  ///< of at least kLeastVoid_mm3, the largest first
  double largest_void_mm3 = 0.0;   ///< of any size
  double extruded_mm3 = 0.0;       ///< beyond the foramen

  /// Rims are read to a hundredth.
  double share() const { return canal_mm3 > 0.0 ? std::min(1.0, filled_mm3 / canal_mm3) : 0.0; }
};

/// "short", "right", "long".
const char* lengthWord(const RootFilling& filling);
/// "filled to -0.2 mm, 96 %, no void", "filled to +1.1 mm, long, 91 %, 2 voids, 0.21 mm³ beyond the foramen".
std::string fillingWords(const RootFilling& filling);

/// None: nothing was laid in this canal. `sections`: of the canal that is number `canal` of the tooth, in `now`.
std::optional<RootFilling> rootFilling(CanalSections& sections, const FineSolid& now, const FineSolid& laid,
                                       const assets::ToothCanals& tooth, std::size_t canal);

}  // namespace app
