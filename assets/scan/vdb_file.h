// A CtVolume as one OpenVDB file, readable by any OpenVDB tool:
//   "hu"    float, Hounsfield, background -1000 (air)      float because every tool draws it; int16 survives exactly
//   "label" int32, Tissue, background 0
//   "tooth" int32, FDI number of the tooth a voxel belongs to, background 0; left out if no tooth is told apart
//   "solid" float, fraction 0..1 (a fog volume), background 0; the byte is round(255 fraction)
// One linear transform for all, index to P in mm (LPS). File metadata: molar_volume_schema = 1, frame, size_ijk (how
// far the volume reaches; the grids are sparse). The file ends in a seal (file_checksum.h), so a foreign or damaged
// file is refused at once; as a seal can be forged and OpenVDB trusts its input, a process of its own reads it
// (volume_reader.h). Any thread; about 10 ns a voxel and grid; a dense copy in memory.
#pragma once

#include <string>

#include "assets/ct_volume.h"

namespace assets {

/// Writes over what is there: for a file inside an OutputFolder or an OutputFile's temporary. Throws LoadError.
void writeVdb(const CtVolume& volume, const std::string& path);

/// Throws LoadError: missing, damaged, foreign, another schema, a grid missing or of another type or place, a value out
/// of range, too many voxels.
CtVolume readVdb(const std::string& path);

}  // namespace assets
