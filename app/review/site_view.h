// From where pictures of a session's site are looked at: from its patient where that is known, else from its bone.
// Frame P, mm. Pure; any thread; a pass over the voxels at most.
#pragma once

#include <cstdint>
#include <span>

#include "app/review/bone_pictures.h"
#include "app/session/session_start.h"
#include "assets/patient.h"

namespace app {

/// `after`: solid at the end, in the order of the grid.
/// `patient`: null where it is not known.
SiteView siteViewOf(const StoredStart& start, const assets::Patient* patient, std::span<const std::uint8_t> after);

}  // namespace app
