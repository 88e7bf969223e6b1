// What a Falcon needs before its run packets: is its program there, and if not, the conversation that brings it. Over
// an opened transport that does not run yet; the thread that opened it. Blocks for seconds; every wait has an end.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace haptics {

class UsbTransport;

/// Progress for a person, and the share done, 0..1. False: give up.
using FalconProgress = std::function<bool(const std::string& words, double share)>;

/// True when run packets are answered. Sends packets without force only.
bool falconRuns(UsbTransport& usb);

/// Throws DeviceError when the unit does not take the program, is unplugged, or `tell` gives up.
void loadFalcon(UsbTransport& usb, std::span<const std::uint8_t> program, const FalconProgress& tell,
                int greetings = 100);

}  // namespace haptics
