#include "app/case/patient_guides.h"

#include "app/case/trough_plan.h"

namespace app {

render::Guides guidesFor(const assets::Patient& patient, double bur_radius_mm) {
  render::Guides guides{patient.mandibular_canal_P_mm, patient.mandibular_canal_radius_mm, {}};
  const auto plan = planBuccalTrough(patient, bur_radius_mm);
  if (!plan) return guides;

  // The bur's centre sweeps along the stroke, from where it rests on the bone down to the depth of the trough.
  const glm::dvec3 outward = glm::normalize(plan->outward_P);
  const double top_mm = plan->bur_radius_mm, bottom_mm = plan->bur_radius_mm - plan->depth_mm;
  guides.cut = {.middle_P_mm = plan->middle_P_mm + 0.5 * (top_mm + bottom_mm) * outward,
                .along_P = glm::normalize(glm::cross(plan->outward_P, plan->aside_P)),
                .outward_P = outward,
                .half_length_mm = 0.5 * plan->length_mm,
                .half_height_mm = 0.5 * (top_mm - bottom_mm),
                .radius_mm = plan->bur_radius_mm};
  return guides;
}

}  // namespace app
