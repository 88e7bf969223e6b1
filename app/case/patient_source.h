// Whom to rehearse on: a patient folder, or the built-in patient, generated once and kept in the user's cache.
// Start-up only: a second to load, up to a minute to generate. Says what it does on stderr.
#pragma once

#include <string>

#include "assets/patient.h"
#include "assets/scenery/face_frame.h"
#include "assets/synthetic/jaw.h"

namespace app {

/// The built-in patient from the cache, or generated and put there. A cache that can not be read is made anew; one
/// that can not be written is done without.
assets::Patient builtInPatient(const assets::JawParameters& parameters);

/// Replaces the patient's face by a glTF model, placed by the `teeth.json` beside it, 1:1. Returns where it stands.
assets::FacePose replaceFace(assets::Patient& patient, const std::string& face_path);

}  // namespace app
