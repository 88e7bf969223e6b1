// What a Falcon needs before its run packets: its firmware file, the test whether it runs, and the loading. Novint's
// driver brings the file; Molar never does. Over an open transport that does not stream yet; the thread that opened it.
// Blocks for seconds; every wait has a limit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "haptics/device/usb/usb_haptic_device.h"

namespace haptics {

/// Throws DeviceError: no such file, not readable, or not the unit's firmware, which has 16-bit words and 1 to 64 KiB
/// (published image: 8492 bytes).
std::vector<std::uint8_t> readFalconProgram(const std::filesystem::path& file);

/// True when run packets are answered. Sends packets without force only.
bool falconRuns(UsbTransport& usb);

/// Throws DeviceError when the unit does not take the program, is unplugged, or `prompt` cancels.
void loadFalcon(UsbTransport& usb, std::span<const std::uint8_t> program, const DevicePrompt& prompt,
                int greetings = 100);

}  // namespace haptics
