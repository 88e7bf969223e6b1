// The header of a NIfTI-1 file in one piece (.nii, or packed .nii.gz), of either byte order
// (nifti.nimh.nih.gov/nifti-1). Place: the sform if there is one, else the qform; pixdim must be sizes and agree with
// the sform. Units m, mm, um, or none stated (mm). Rescale: scl_slope and scl_inter. Refused: no orientation, shear
// above a thousandth, NIfTI-2, Analyze and .hdr/.img pairs.
#pragma once

#include "assets/scan/image_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

ImageHeader readNiftiHeader(const RegularFile& file);

}  // namespace assets
