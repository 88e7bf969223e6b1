// The file `patient.toml` of a patient folder: schema, title, jaw, site, mandibular canal, classification. Lengths in
// mm in frame P (LPS), units in the key names. Schema 1 (a site table with `known`) is still read. Any thread;
// microseconds.
#pragma once

#include <string>

#include "assets/patient.h"

namespace assets {

/// Everything of the patient but ct, gingiva and face.
std::string patientToml(const Patient& patient);

/// A Patient without ct, gingiva and face. `where` names the file in messages. Throws LoadError of one line: invalid
/// TOML, unknown schema, a missing key, a number that is not finite or out of range.
Patient patientFromToml(const std::string& text, const std::string& where);

}  // namespace assets
