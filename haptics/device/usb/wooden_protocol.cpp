#include "haptics/device/usb/wooden_protocol.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

constexpr std::size_t kWords = kWoodenReportBytes / 2;
constexpr std::int16_t kPreset = 1;
/// More counts than the handle's range: the button.
constexpr int kButtonFrom = 5000, kButton = 10'000;

using Words = std::array<std::int16_t, kWords>;

UsbReport reportOf(const Words& words) {
  std::array<std::uint8_t, kWoodenReportBytes> bytes{};
  for (std::size_t i = 0; i < kWords; ++i) {
    const auto word = static_cast<std::uint16_t>(words[i]);
    bytes[2 * i] = static_cast<std::uint8_t>(word & 0xff);
    bytes[2 * i + 1] = static_cast<std::uint8_t>(word >> 8);
  }
  return UsbReport(bytes);
}

}  // namespace

std::optional<WoodenReading> decodeWoodenReading(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kWoodenReportBytes) return {};
  Words words{};
  for (std::size_t i = 0; i < kWords; ++i)
    words[i] = static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[2 * i] | bytes[2 * i + 1] << 8));
  WoodenReading reading;
  std::copy_n(words.begin(), 6, reading.encoders.begin());
  reading.button = words[3] > kButtonFrom;
  if (reading.button) reading.encoders[3] = static_cast<std::int16_t>(words[3] - kButton);
  reading.switch_pressed = words[6] == 1;
  return reading;
}

UsbReport encodeWoodenCurrents(const std::array<double, 3>& currents_mA) {
  constexpr double kMost = 32'767.0;
  Words words{};
  for (std::size_t i = 0; i < 3; ++i)
    if (std::isfinite(currents_mA[i]))
      words[i] = static_cast<std::int16_t>(std::lround(std::clamp(currents_mA[i], -kMost, kMost)));
  return reportOf(words);
}

UsbReport encodeWoodenPreset(const std::array<std::int16_t, 6>& encoders) {
  // a, b, c in the attributes, d, e, f in place of the currents.
  return reportOf({encoders[3], encoders[4], encoders[5], kPreset, encoders[0], encoders[1], encoders[2]});
}

}  // namespace haptics
