// The packets of the Novint Falcon on its serial bridge: 16 ASCII bytes each way, each nibble of a word as a letter
// from 'A' on, least significant first, between '<' and '>'. Encoders and motor words are counts without a unit. Every
// USB packet in starts with two modem bytes of the FTDI bridge. Anything that is not exactly a packet is rejected. Any
// thread; a few dozen instructions, no allocation. Source: libnifalcon/libnifalcon, FalconFirmwareNovintSDK.cpp,
// FalconCommLibUSB.cpp (facts; reference/devices 3.2). Never run against a real unit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace haptics {

inline constexpr std::uint16_t kFalconVendor = 0x0403, kFalconProduct = 0xCB48;
inline constexpr int kMaxFalconMotorWord = 4096;

using FalconPacket = std::array<std::uint8_t, 16>;

enum class FalconLights : std::uint8_t { none = 0, green = 2, blue = 4, red = 8 };

struct FalconCommand {
  std::array<int, 3> motor_words{};  ///< clamped to +-4096
  bool homing = true;                ///< encoders count from the homing slots; public programs leave it on
  FalconLights lights = FalconLights::none;
};

struct FalconReport {
  std::array<std::int16_t, 3> encoders{};
  std::uint8_t buttons = 0;  ///< bits 0..3: of the grip
  std::uint8_t homed = 0;    ///< bits 0..2: this leg has passed its homing slot

  bool isHomed() const { return homed == 7; }
};

FalconPacket encoded(const FalconCommand& command) noexcept;
/// None unless it is 16 bytes, framed, every nibble a nibble. Byte 14 is not published and may be anything.
std::optional<FalconReport> decodeFalconReport(std::span<const std::uint8_t> bytes) noexcept;

/// Strips the two modem bytes from each 64-byte packet of a bulk transfer. Returns the bytes written to `payload`,
/// which must be as long as `transfer`.
std::size_t ftdiPayload(std::span<const std::uint8_t> transfer, std::span<std::uint8_t> payload) noexcept;

/// Assembles packets from a stream that splits them anywhere; resynchronises after garbage.
class FalconStream {
 public:
  /// The newest decodable packet that ends in this payload of the bridge.
  std::optional<FalconPacket> take(std::span<const std::uint8_t> payload) noexcept;
  std::uint64_t rejected() const { return rejected_; }  ///< bytes that belonged to no packet

 private:
  void startAgain() noexcept;

  FalconPacket packet_{};
  std::size_t filled_ = 0;
  std::uint64_t rejected_ = 0;
};

}  // namespace haptics
