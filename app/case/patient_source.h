// The built-in patient, generated once and kept in the user's cache, and face models. Start-up only: a second to load,
// up to a minute to generate; reports on stderr.
#pragma once

#include <string>

#include "assets/patient.h"
#include "assets/progress.h"
#include "assets/scenery/face_frame.h"
#include "assets/synthetic/jaw.h"

namespace app {

/// From the cache, or generated and cached. An unreadable cache is generated again; an unwritable one is ignored.
assets::Patient builtInPatient(const assets::JawParameters& parameters, const assets::ReportProgress& report = {});

/// Replaces the patient's face by a glTF model, placed by the `teeth.json` next to it, 1:1. Returns its pose.
assets::FacePose replaceFace(assets::Patient& patient, const std::string& face_path);

}  // namespace app
