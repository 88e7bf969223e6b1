// A volume as it lies in memory, for a cache: read in a tenth of the time that OpenVDB takes (volume.vdb, which is for
// people's own folders and other programs). Little endian: 8 bytes "MOLARPLV", CRC-32 of all that follows, size,
// whether teeth are numbered, spacing, origin, then Hounsfield, labels, solid and teeth. The checksum finds accidents,
// not forgery; values are judged. Any thread; about 10 ms a million voxels, 5 bytes each on the disk.
#pragma once

#include <string>

#include "assets/ct_volume.h"

namespace assets {

/// Written whole or not at all, over what is there. Throws CalibrationError.
void writePlainVolume(const CtVolume& volume, const std::string& path);

/// Throws LoadError: no such file, damaged, foreign, a value out of range.
CtVolume readPlainVolume(const std::string& path);

}  // namespace assets
