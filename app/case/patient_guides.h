// What may guide the surgeon on this patient: the mandibular canal, and the cut that is planned. Pure; any thread.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "render/volume/guide_field.h"

namespace app {

/// No cut: the canal alone.
render::Guides guidesFor(const assets::Patient& patient, const std::optional<assets::PlannedCut>& cut);

}  // namespace app
