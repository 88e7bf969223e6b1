// Guides drawn on a patient: mandibular canal and planned cut. Pure; any thread.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "render/volume/guide_field.h"

namespace app {

render::Guides guidesFor(const assets::Patient& patient, const std::optional<assets::PlannedCut>& cut);

}  // namespace app
