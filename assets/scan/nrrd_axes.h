// Geometry of an NRRD file in P (LPS mm): sizes, spacings, kinds, units and directions of its axes, reduced to three.
// Non- spatial axes are dropped, then axes of size 1 from the end. Throws LoadError of one line. Any thread.
#pragma once

#include "assets/scan/nrrd_fields.h"
#include "assets/scan/resampling.h"

namespace assets {

ScanGeometry nrrdGeometry(const NrrdFields& fields);

}  // namespace assets
