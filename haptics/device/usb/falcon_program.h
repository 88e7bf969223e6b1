// The program that runs in the Falcon, as a file of its owner: Novint's driver brings it, Molar never does. Start-up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace haptics {

/// Throws DeviceError when the file is not there, not readable, or can not be a program of the unit: 16-bit
/// words, 1 to 64 KiB (the published image has 8492 bytes).
std::vector<std::uint8_t> readFalconProgram(const std::filesystem::path& file);

}  // namespace haptics
