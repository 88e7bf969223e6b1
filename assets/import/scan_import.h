// A patient from a scan: a folder with ct.nrrd (and labels.nrrd with our Tissue values), or a lone volume file in
// Hounsfield. .nrrd, .nhdr, .nii, .nii.gz, .mha and .mhd; any orientation (image_file.h). With labels: third molar, its
// side and crown direction, canal line. Without: tissues are guessed from grey values (tissue_from_grey.h) and the site
// is unknown, the middle of the solid mass. Nothing of the file but voxels and geometry is kept: no name, date or
// identifier, not even the file's own name. Any thread, at start-up (see image_file.h); about 2 s per 10^7 voxels. Gum
// and face are made elsewhere. No DICOM yet.
#pragma once

#include <string>

#include "assets/patient.h"

namespace assets {

/// Throws LoadError of one line.
Patient importScan(const std::string& source, const Classification& classification);

}  // namespace assets
