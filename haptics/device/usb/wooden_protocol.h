// The reports of a WoodenHaptics, 14 bytes each way, little-endian int16. In: six encoders and the calibration switch.
// Out: three currents, or a preset of the encoders, which switches the motors off. A button on the handle adds 10000 to
// encoder d. mA, counts. Any thread; no allocation. Facts of forsslund/haptikfabrikenapi, firmware/main.cpp and
// src/fsusbhapticdevicethread.cpp (reference/devices 3.1).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "haptics/device/usb/usb_report.h"

namespace haptics {

inline constexpr std::uint16_t kWoodenVendor = 0x1234, kWoodenProduct = 0x0006;
inline constexpr std::size_t kWoodenReportBytes = 14;

struct WoodenReading {
  std::array<std::int16_t, 6> encoders{};  ///< a to f, d without the button
  bool button = false;
  bool switch_pressed = false;  ///< since the encoders were last set
};

/// None unless it is 14 bytes long. Any 14 bytes are a reading.
std::optional<WoodenReading> decodeWoodenReading(std::span<const std::uint8_t> bytes);

/// Clamped to int16; 0 for a value that is not finite.
UsbReport encodeWoodenCurrents(const std::array<double, 3>& currents_mA);
inline UsbReport woodenRest() { return encodeWoodenCurrents({0.0, 0.0, 0.0}); }

UsbReport encodeWoodenPreset(const std::array<std::int16_t, 6>& encoders);

}  // namespace haptics
