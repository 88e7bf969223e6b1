#include "app/case/closed_gum.h"

#include "app/case/gutter_plan.h"
#include "assets/scenery/gingiva_surface.h"

namespace app {

std::optional<assets::MeshModel> closedGum(const assets::Patient& patient) {
  const auto cut = planGutter(patient, kUsualBurRadius_mm);
  if (!cut) return {};
  const assets::MeshModel gum = assets::gingivaSurface(patient.ct, std::nullopt);
  if (gum.parts.empty()) return {};
  return assets::withFlapPart(gum, *cut);
}

}  // namespace app
