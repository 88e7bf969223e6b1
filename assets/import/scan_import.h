// A patient from a scan: a folder with ct.nrrd and, next to it, labels.nrrd (Tissue values) and teeth.nrrd (FDI
// numbers), or a single volume file in Hounsfield; .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd in any orientation
// (image_file.h). The site is the requested tooth, or a third molar: one numbered in teeth.nrrd, or the only tooth with
// labelled enamel and dentine if the scan shows its side. The canal's line comes from labels; without labels tissues
// are estimated from grey values and no tooth is. Only voxels and geometry are kept: no name, date or identifier, not
// even the file name. Gingiva and face are made elsewhere. No DICOM. Any thread, at start-up; about 2 s per 10^7
// voxels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/patient.h"
#include "assets/scan/grey_window.h"

namespace assets {

struct ScanImportOptions {
  Classification classification{};
  std::optional<int> tooth_fdi{};      ///< the site; default: a third molar
  std::optional<GreyWindow> window{};  ///< for an 8-bit volume
};

struct ImportedScan {
  Patient patient;
  std::vector<std::string> remarks;  ///< notes and warnings for the user, a line each
};

/// Throws LoadError of one line.
ImportedScan importScan(const std::string& source, const ScanImportOptions& options);

}  // namespace assets
