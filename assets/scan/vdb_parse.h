// Reads a CtVolume from OpenVDB in this process. Only for the reading process (volume_reader.h): OpenVDB trusts its
// input and crashes, hangs or exhausts memory on a manipulated file. Format: vdb_file.h. About 10 ns a voxel and grid.
// Throws LoadError, std::bad_alloc.
#pragma once

#include <string>

#include "assets/ct_volume.h"

namespace assets {

inline constexpr int kVdbSchema = 1;
inline constexpr const char* kVdbSchemaName = "molar_volume_schema";
inline constexpr const char* kVdbSizeName = "size_ijk";

CtVolume parseVdb(const std::string& path);

}  // namespace assets
