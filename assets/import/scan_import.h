// A patient from a scan: a folder with ct.nrrd, and beside it labels.nrrd (our Tissue values) and teeth.nrrd (the FDI
// number of the tooth each voxel belongs to), or a lone volume file in Hounsfield. .nrrd, .nhdr, .nii, .nii.gz, .mha
// and .mhd; any orientation (image_file.h). The site is the tooth asked for, or a third molar: one numbered in
// teeth.nrrd, or without that the only tooth whose enamel and dentine are labelled, if the scan shows its side. Labels
// give the mandibular canal's line; without them tissues are guessed from grey values and no tooth is. Nothing of the
// file but voxels and geometry is kept: no name, date or identifier, not even the file's own name. Any thread, at
// start-up (see image_file.h); about 2 s per 10^7 voxels. Gingiva and face are made elsewhere. No DICOM yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/patient.h"
#include "assets/scan/grey_window.h"

namespace assets {

struct ScanImportOptions {
  Classification classification{};
  std::optional<int> tooth_fdi{};      ///< the site; none: a third molar
  std::optional<GreyWindow> window{};  ///< of an 8-bit volume
};

struct ImportedScan {
  Patient patient;
  std::vector<std::string> remarks;  ///< what people should know of this scan, a line each
};

/// Throws LoadError of one line.
ImportedScan importScan(const std::string& source, const ScanImportOptions& choices);

}  // namespace assets
