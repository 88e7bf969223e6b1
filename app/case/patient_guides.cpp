#include "app/case/patient_guides.h"

namespace app {

render::Guides guidesFor(const assets::Patient& patient, const std::optional<assets::PlannedCut>& cut) {
  render::Guides guides{patient.mandibular_canal_P_mm, patient.mandibular_canal_radius_mm, {}};
  if (!cut) return guides;

  // The bur's centre moves along the stroke, from the surface down to the depth of the trough.
  const glm::dvec3 outward = glm::normalize(cut->outward_P);
  const double top_mm = cut->bur_radius_mm, bottom_mm = cut->bur_radius_mm - cut->depth_mm;
  guides.cut = {.middle_P_mm = cut->middle_P_mm + 0.5 * (top_mm + bottom_mm) * outward,
                .along_P = glm::normalize(glm::cross(cut->outward_P, cut->lateral_P)),
                .outward_P = outward,
                .half_length_mm = 0.5 * cut->length_mm,
                .half_height_mm = 0.5 * (top_mm - bottom_mm),
                .radius_mm = cut->bur_radius_mm};
  return guides;
}

}  // namespace app
