// The header of an NRRD file, attached (.nrrd) or by itself (.nhdr), versions 1 to 5
// (teem.sourceforge.net/nrrd/format.html). Raw, gzip, ascii and hex voxels; one data file, LIST or numbered names; line
// and byte skip; spaces LPS and RAS, or none named (taken as LPS); units mm, m, cm, um. Axes of size 1 that are no axes
// of space are dropped. Stricter than the format: no unknown field, none twice, no voxel size that is not stated.
#pragma once

#include "assets/scan/image_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

ImageHeader readNrrdHeader(const RegularFile& file);

}  // namespace assets
