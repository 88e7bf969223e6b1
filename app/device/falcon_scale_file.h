// The file that keeps what a spring scale showed of one Novint Falcon: a few TOML lines with their version, written
// when it has been weighed, read before it is opened. Start-up. Throws UsageError when the file can not be read, is of
// another version or holds what nobody could have weighed, assets::LoadError when it can not be written.
#pragma once

#include <string>

#include "haptics/device/usb/falcon_force_scale.h"

namespace app {

/// Where it is looked for: molar/falcon.toml beneath XDG_CONFIG_HOME or ~/.config.
std::string defaultFalconScaleFile();

/// As weighed where the file is there, else as guessed.
haptics::FalconForceScale savedFalconScale(const std::string& path);
haptics::FalconForceScale readFalconScale(const std::string& path);
void writeFalconScale(const std::string& path, const haptics::FalconForceScale& scale, bool overwrite);

}  // namespace app
