// Header of a single-file NIfTI-1 image (.nii, compressed .nii.gz), either byte order (nifti.nimh.nih.gov/nifti-1).
// Geometry from the sform, else the qform; pixdim must be positive and agree with the sform. Units m, mm, um, or none
// (mm). Rescaled by scl_slope and scl_inter. Rejected: no orientation, shear above 0.001, NIfTI-2, Analyze and
// .hdr/.img pairs.
#pragma once

#include "assets/scan/image_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

ImageHeader readNiftiHeader(const RegularFile& file);

}  // namespace assets
