// The gum of a patient before the incision, of a rehearsal that begins with it closed. Frame P. Start-up; a second.
#pragma once

#include <optional>

#include "assets/mesh.h"
#include "assets/patient.h"

namespace app {

/// With the site's part a tissue of its own, which gives way once it is raised. None: no gum is labelled, or no cut is
/// planned under it.
std::optional<assets::MeshModel> closedGum(const assets::Patient& patient);

}  // namespace app
