// Header of an NRRD file, attached (.nrrd) or detached (.nhdr), versions 1 to 5
// (teem.sourceforge.net/nrrd/format.html). Raw, gzip, ascii and hex voxels; one data file, LIST or numbered names; line
// and byte skip; spaces LPS and RAS, or none (taken as LPS); units mm, m, cm, um. Stricter than the format: unknown or
// repeated fields and unstated voxel sizes are rejected.
#pragma once

#include "assets/scan/image_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

ImageHeader readNrrdHeader(const RegularFile& file);

}  // namespace assets
