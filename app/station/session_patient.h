// The patient of a recorded session, for what is drawn and planned after it. Start-up only; seconds where the built-in
// patient has to be made.
#pragma once

#include <optional>
#include <string>

#include "app/session/session_start.h"
#include "assets/patient.h"

namespace app {

/// With its bone before the first cut; `folder`: of an imported patient, empty: not named. None: it is not known, or
/// the built-in one is of another version. Throws UsageError if the folder holds another patient.
std::optional<assets::Patient> patientOfSession(const StoredStart& start, const std::string& folder);

/// What the session itself knows of its patient: bone, teeth, site and canal; no face, no gum, no grey values.
assets::Patient patientWithinSession(const StoredStart& start);

}  // namespace app
