// The devices configured in the vendor's set-up, read from its files without starting any: folder `config` of
// GTDD_HOME, else of ~/.3dsystems, else of /usr/share/3DSystems, a file "NAME.config" each, "Default Device" being the
// default (reference/devices 1). Loads the library to see whether it can be used. Any thread but the servo's.
#pragma once

#include <string>
#include <vector>

#include "haptics/device/found_device.h"

namespace haptics {

/// Configured devices, and the default device if the library is there. `library`: as HdLibrary takes it.
std::vector<FoundDevice> findOpenHaptics(const std::string& library = {});

}  // namespace haptics
