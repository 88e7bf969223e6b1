// A patient on disk, a folder of three files: patient.toml (patient_toml.h), volume.vdb (vdb_file.h: HU, labels, teeth,
// solid) and face.glb (gingiva and face, metres, frame F with P's origin: gingiva parts are those whose names begin
// with "Gum"; left out if both are empty). Written whole or not at all; carries no name, date or identifier of a
// person. Any thread; a second or so per 10^7 voxels, with the dense volume in memory. The folder's name is the case's
// name.
#pragma once

#include <string>

#include "assets/patient.h"

namespace assets {

/// Throws as OutputFolder: no parent folder, not writable, in place already without `overwrite`, or in place and
/// holding anything else (which would be lost).
void savePatient(const Patient& patient, const std::string& folder, bool overwrite);

/// Throws LoadError: no such folder, a file missing, damaged or of another program, a value out of range.
Patient loadPatient(const std::string& folder);

}  // namespace assets
