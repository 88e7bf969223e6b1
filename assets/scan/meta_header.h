// The header of a MetaImage file, attached (.mha) or by itself (.mhd), as MetaIO writes it (itk.org/Wiki/MetaIO).
// Raw, zlib and ASCII voxels; LOCAL, one data file, LIST or numbered names; HeaderSize. Axes in LPS; without a
// TransformMatrix they lie along them. Fields not named here are passed over, as MetaIO lets writers add their own.
#pragma once

#include "assets/scan/image_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

ImageHeader readMetaHeader(const RegularFile& file);

}  // namespace assets
