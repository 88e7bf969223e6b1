// What may guide the surgeon on this patient: the mandibular canal, and the trough that is planned beside the crown.
// Start-up only; milliseconds.
#pragma once

#include "assets/patient.h"
#include "render/volume/guide_field.h"

namespace app {

render::Guides guidesFor(const assets::Patient& patient, double bur_radius_mm);

}  // namespace app
