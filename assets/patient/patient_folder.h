// A patient on disk: a folder with patient.toml (patient_toml.h), volume.vdb (vdb_file.h) and face.glb: gingiva and
// face in metres, frame F with P's origin; gingiva parts are those whose names begin with "Gum"; left out if both are
// empty; of an imported DICOM scan deidentified.toml (scan_origin_toml.h); and where the
// program found the jaw clicks.json, a person's clicks as they were given to `molar import --clicks`. Written whole or
// not at all. Contains no name, date or identifier of a person; the folder's name names the case. What is stable:
// README.md. Any thread; about 1 s per 10^7 voxels.
#pragma once

#include <functional>
#include <string>

#include "assets/patient.h"
#include "assets/progress.h"
#include "assets/scan_origin.h"

namespace assets {

/// While a folder is written beside its place.
struct FolderWatch {
  std::function<void(const std::string& folder)> begun{};  ///< it is there, empty, and may be written into
  std::function<void()> before_commit{};  ///< all of it is on the disk; if it throws, nothing is left of it
};

/// Throws as OutputFolder: no parent folder, not writable, already present without `overwrite`, or present with other
/// content, which would be lost. `origin`: of a DICOM scan; it is written, and not read back. `clicks`: of
/// clicks.json; empty: none is written.
void savePatient(const Patient& patient, const std::string& folder, bool overwrite, const ScanOrigin* origin = nullptr,
                 const std::string& clicks = {}, const FolderWatch& watch = {});

/// What became of deidentified.toml.
enum class StatementAfterEdits {
  none,           ///< the folder has none
  renewed,        ///< of the new volume, signed
  review_lapsed,  ///< the same, and it was reviewed: this volume is not
  left_unsigned   ///< it was changed, or is of another volume: as it was, so that it stays in doubt
};

/// Replaces a patient folder by the patient after edits; what is told of its scan stays. Throws as savePatient().
StatementAfterEdits savePatientAgain(const Patient& patient, const std::string& folder, const std::string& clicks);

/// Of a patient folder, for clicks.json.
std::string clicksPath(const std::string& folder);

/// Of a patient folder, for check.png: what was found, as a picture; it is not read.
std::string checkPicturePath(const std::string& folder);

/// The volume is read beside the meshes. Throws LoadError: no such folder, a file missing, damaged or foreign, a value
/// out of range.
Patient loadPatient(const std::string& folder, const ReportProgress& report = {});

/// Everything but ct, gingiva and face, of patient.toml alone; microseconds. Throws LoadError.
Patient describedPatient(const std::string& folder);

/// The same of a folder whose volume is known: asked for after the meshes were read, the file is not.
Patient loadPatient(const std::string& folder, const std::function<CtVolume()>& volume);

}  // namespace assets
