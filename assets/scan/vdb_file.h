// A CtVolume as one OpenVDB file, readable by any OpenVDB tool:
//   "hu"    float, Hounsfield, background -1000 (air)
//   "label" int32, Tissue, background 0
//   "tooth" int32, FDI number of the voxel's tooth, background 0; left out if no tooth is numbered
//   "solid" float, fraction 0..1 (a fog volume), background 0; the byte is round(255 fraction)
// One linear transform, index to P in mm (LPS). Metadata: molar_volume_schema = 1, frame, size_ijk (extent of the
// volume; the grids are sparse). The file ends in a checksum (file_checksum.h) and is read in a child process
// (volume_reader.h). Any thread; about 10 ns a voxel and grid; a dense copy in memory.
#pragma once

#include <memory>
#include <string>

#include "assets/ct_volume.h"
#include "assets/scan/volume_reader.h"

namespace assets {

/// Overwrites: for files in an OutputFolder or an OutputFile's temporary. Throws LoadError.
void writeVdb(const CtVolume& volume, const std::string& path);

/// Throws LoadError: missing, damaged, foreign, another schema, a grid missing or of another type or transform, a value
/// out of range, too many voxels.
CtVolume readVdb(const std::string& path);

/// The same, read beside the caller until it is taken. Throws as readVdb, at once what the checksum shows.
std::unique_ptr<VolumeInChild> beginVdb(const std::string& path);

}  // namespace assets
