// The table [scan] of patient.toml, and deidentified.toml: the statement of what an imported scan kept and dropped. Any
// thread.
#pragma once

#include <string>

#include "assets/scan_origin.h"

namespace assets {

/// "\n[scan]\n…": how the scan was made and its grey values mapped.
std::string scanTable(const ScanOrigin& origin);

/// `volume_sha256`: 64 hexadecimal digits of volume.vdb.
std::string deidentificationStatement(const ScanOrigin& origin, const std::string& volume_sha256);

}  // namespace assets
