// Where an NRRD file's voxels lie: its axes' sizes, spacings, kinds, units and directions, dropped to three, in P (LPS
// mm). Axes that are none of space go, then others of size 1 from the end. Throws LoadError of one line: what is not
// stated, is no length, or leaves other than three axes. Any thread.
#pragma once

#include "assets/scan/nrrd_fields.h"
#include "assets/scan/resampling.h"

namespace assets {

ScanGeometry nrrdGeometry(const NrrdFields& fields);

}  // namespace assets
