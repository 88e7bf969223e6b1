// The measured force scale of a Novint Falcon as a TOML file with a version: written after `molar devices check`, read
// before the device is opened. Start-up. Throws UsageError when the file cannot be read, has another version or
// impossible values, assets::LoadError when it cannot be written.
#pragma once

#include <string>

#include "haptics/device/usb/falcon_force_scale.h"

namespace app {

/// molar/falcon.toml in XDG_CONFIG_HOME or ~/.config.
std::string defaultFalconScaleFile();

/// From the file if it exists, else the default.
haptics::FalconForceScale savedFalconScale(const std::string& path);
haptics::FalconForceScale readFalconScale(const std::string& path);
void writeFalconScale(const std::string& path, const haptics::FalconForceScale& scale, bool overwrite);

}  // namespace app
