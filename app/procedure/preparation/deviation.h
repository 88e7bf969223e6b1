// P2 and P8: how far the surface that was made lies from the ideal's (reference/sisters 5.3), place by place, positive
// where too much is left. The way to the ideal is that of its distance field, the distance itself the sum of the solid
// along it, some µm at 0.05 mm. Frame P, mm. The ideal's field is made once (some 0.5 s); then 5 µs a place. Any
// thread.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "app/procedure/preparation/crown.h"
#include "haptics/body/distance_field.h"

namespace app {

/// P8: of distances.
inline constexpr std::array<double, 5> kTolerances_mm{0.1, 0.2, 0.3, 0.4, 0.5};

class IdealDistance {
 public:
  static constexpr double kBand_mm = 2.5;

  /// The ideal must outlive it.
  explicit IdealDistance(const BoxBytes& ideal);
  /// Positive outside of the ideal.
  double at_mm(const glm::dvec3& p_P_mm) const;

 private:
  const BoxBytes& ideal_;
  haptics::DistanceField field_;
};

struct DeviationPlace {
  glm::vec3 p_P_mm{0.0F}, out_P{0.0F};
  float deviation_mm = 0.0F, area_mm2 = 0.0F;
};

struct Deviation {
  std::vector<DeviationPlace> places;
  double area_mm2 = 0.0;
  double mean_mm = 0.0, rms_mm = 0.0;
  double most_left_mm = 0.0, deepest_mm = 0.0;         ///< 99th percentiles of area: left too high, cut too deep
  std::array<double, kTolerances_mm.size()> within{};  ///< P8: share of the surface
};

/// The value below which a share of the area lies; sorts the pairs of value and area. 0 of none.
double areaPercentile(std::vector<std::pair<double, double>>& value_area, double share);

Deviation deviationOf(const Crown& crown, const BoxBytes& made, const BoxBytes& ideal, const IdealDistance& distance);

}  // namespace app
