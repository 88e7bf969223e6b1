// The words and numbers of a patient folder, `patient.toml`: schema, title, jaw, site, canal, classification;
// lengths in mm in frame P (LPS), units in the names. Any thread; microseconds. No voxels, no meshes, no name, date or
// identifier of a person: the title says what the case is.
// Schema 1 (one table for a site, known or not) is still read.
#pragma once

#include <string>

#include "assets/patient.h"

namespace assets {

/// The text for everything of the patient but ct, gingiva and face.
std::string patientToml(const Patient& patient);

/// A Patient without ct, gingiva and face. `where` names the file in refusals. Throws LoadError of one line: not TOML,
/// another schema, a missing key, a number that is not finite or out of its range.
Patient patientFromToml(const std::string& text, const std::string& where);

}  // namespace assets
