#include "app/procedure/preparation/deviation.h"

#include <algorithm>
#include <cmath>

#include "app/procedure/preparation/made_surface.h"

namespace app {
double areaPercentile(std::vector<std::pair<double, double>>& value_area, double share) {
  if (value_area.empty()) return 0.0;
  std::ranges::sort(value_area);
  double all = 0.0, sum = 0.0;
  for (const auto& [value, area] : value_area) all += area;
  for (const auto& [value, area] : value_area)
    if ((sum += area) >= share * all) return value;
  return value_area.back().first;
}

IdealDistance::IdealDistance(const BoxBytes& ideal) : ideal_(ideal), field_(ideal.grid(), ideal.bytes(), kBand_mm) {}

double IdealDistance::at_mm(const glm::dvec3& p_P_mm) const {
  const auto near = field_.at(glm::vec3(field_.grid().indexFromPoint(p_P_mm)));
  const double rough_mm = static_cast<double>(near.distance_mm), slope = glm::length(glm::dvec3(near.gradient));
  if (std::abs(rough_mm) >= kBand_mm - 0.01 || slope < 1e-6) return rough_mm;
  // Across the surface, out of the ideal: as much of the stretch as is solid lies before the surface.
  const glm::dvec3 out_P = glm::dvec3(near.gradient) / slope;
  const double half_mm = wallReach_mm(ideal_.grid());
  const glm::dvec3 from_P = p_P_mm - (rough_mm + half_mm) * out_P;
  return rough_mm + half_mm - ideal_.solidBetween_mm(from_P, out_P, 2.0 * half_mm);
}

Deviation deviationOf(const Crown& crown, const BoxBytes& made, const BoxBytes& ideal, const IdealDistance& distance) {
  Deviation deviation;
  std::vector<std::pair<double, double>> value_area;
  double sum = 0.0, squares = 0.0;
  forPreparedSurface(crown, made, ideal, [&](const SurfacePlace& place) {
    const double mm = distance.at_mm(place.p_P_mm);
    deviation.places.push_back(
        {glm::vec3(place.p_P_mm), glm::vec3(place.out_P), static_cast<float>(mm), static_cast<float>(place.area_mm2)});
    value_area.emplace_back(mm, place.area_mm2);
    deviation.area_mm2 += place.area_mm2;
    sum += place.area_mm2 * mm, squares += place.area_mm2 * mm * mm;
    for (std::size_t n = 0; n < kTolerances_mm.size(); ++n)
      if (std::abs(mm) <= kTolerances_mm[n]) deviation.within[n] += place.area_mm2;
  });
  if (deviation.area_mm2 <= 0.0) return deviation;
  for (double& within : deviation.within) within /= deviation.area_mm2;
  deviation.mean_mm = sum / deviation.area_mm2;
  deviation.rms_mm = std::sqrt(squares / deviation.area_mm2);
  deviation.most_left_mm = std::max(0.0, areaPercentile(value_area, 0.99));
  deviation.deepest_mm = std::max(0.0, -areaPercentile(value_area, 0.01));
  return deviation;
}

}  // namespace app
