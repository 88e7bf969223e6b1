// Header of a MetaImage file, attached (.mha) or detached (.mhd), as MetaIO writes it (itk.org/Wiki/MetaIO). Raw, zlib
// and ASCII voxels; LOCAL, one data file, LIST or numbered names; HeaderSize. Axes in LPS, along P without a
// TransformMatrix. Unknown fields are ignored, as MetaIO lets writers add their own.
#pragma once

#include "assets/scan/image_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

ImageHeader readMetaHeader(const RegularFile& file);

}  // namespace assets
