// A patient on disk: a folder with patient.toml (patient_toml.h), volume.vdb (vdb_file.h) and face.glb: gingiva and
// face in metres, frame F with P's origin; gingiva parts are those whose names begin with "Gum"; left out if both are
// empty; and of an imported DICOM scan deidentified.toml (scan_origin_toml.h). Written whole or not at all. Contains no
// name, date or identifier of a person; the folder's name names the case. What is stable: README.md. Any thread; about
// 1 s per 10^7 voxels.
#pragma once

#include <functional>
#include <string>

#include "assets/patient.h"
#include "assets/progress.h"
#include "assets/scan_origin.h"

namespace assets {

/// Throws as OutputFolder: no parent folder, not writable, already present without `overwrite`, or present with other
/// content, which would be lost. `origin`: of a DICOM scan; it is written, and not read back.
void savePatient(const Patient& patient, const std::string& folder, bool overwrite, const ScanOrigin* origin = nullptr);

/// The volume is read beside the meshes. Throws LoadError: no such folder, a file missing, damaged or foreign, a value
/// out of range.
Patient loadPatient(const std::string& folder, const ReportProgress& report = {});

/// Everything but ct, gingiva and face, of patient.toml alone; microseconds. Throws LoadError.
Patient describedPatient(const std::string& folder);

/// The same of a folder whose volume is known: asked for after the meshes were read, the file is not.
Patient loadPatient(const std::string& folder, const std::function<CtVolume()>& volume);

}  // namespace assets
