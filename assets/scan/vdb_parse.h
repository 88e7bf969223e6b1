// OpenVDB's bytes to a CtVolume, in this process: only for the process that is made for it (volume_reader.h), as
// OpenVDB trusts its input and crashes, hangs or fills the memory on a file that was changed with intent. The grids and
// what is asked of them: vdb_file.h. About 10 ns a voxel and grid. Throws LoadError, std::bad_alloc.
#pragma once

#include <string>

#include "assets/ct_volume.h"

namespace assets {

inline constexpr int kVdbSchema = 1;
inline constexpr const char* kVdbSchemaName = "molar_volume_schema";
inline constexpr const char* kVdbSizeName = "size_ijk";

CtVolume parseVdb(const std::string& path);

}  // namespace assets
