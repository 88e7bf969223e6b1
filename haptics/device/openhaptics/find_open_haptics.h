// Which devices the vendor's set-up has configured, read from its files without starting any: folder `config` of
// GTDD_HOME, else of ~/.3dsystems, else of /usr/share/3DSystems, a file "NAME.config" a device, "Default Device" being
// the default (reference/devices 1). Loads the library to see whether it could be used. Any thread but the servo's.
#pragma once

#include <string>
#include <vector>

#include "haptics/device/found_device.h"

namespace haptics {

/// Configured devices, and the default device of a library that is there. `library`: as HdLibrary takes it.
std::vector<FoundDevice> findOpenHaptics(const std::string& library = {});

}  // namespace haptics
