#include "app/case/fitting_cone.h"

#include <algorithm>

#include <fmt/core.h>

namespace app {
namespace {

constexpr double kTipFromForamen_mm = 0.5;  ///< the working length

bool fits(const assets::GuttaPerchaCone& cone, const assets::ToothCanal& canal) {
  const double tip_mm = canal.length_mm() - kTipFromForamen_mm;
  const assets::CanalPlace end = canal.at(tip_mm);
  if (cone.diameter_mm(0.0) > 2.0 * std::min(end.narrow_mm, end.wide_mm)) return false;
  return std::ranges::all_of(canal.places, [&](const assets::CanalPlace& place) {
    return place.along_mm > tip_mm ||
           cone.diameter_mm(tip_mm - place.along_mm) <= 2.0 * std::min(place.narrow_mm, place.wide_mm);
  });
}

}  // namespace

assets::GuttaPerchaCone fittingCone(const assets::ToothCanal& canal) {
  for (int size = assets::kThickestCone; size >= assets::kThinnestCone; size -= assets::kConeStep)
    for (auto taper = assets::kConeTapers.rbegin(); taper != assets::kConeTapers.rend(); ++taper)
      if (const assets::GuttaPerchaCone cone{.size = size, .taper = *taper}; fits(cone, canal)) return cone;
  return {.size = assets::kThinnestCone, .taper = assets::kConeTapers.front()};
}

std::string orderOf(const assets::GuttaPerchaCone& cone) {
  return fmt::format("gp-cone:{},{:.0f}", cone.size, 100.0 * cone.taper);
}

}  // namespace app
