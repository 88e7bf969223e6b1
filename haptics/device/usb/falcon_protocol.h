// The Novint Falcon's words on its serial bridge: 16 ASCII bytes both ways, each nibble of a number as a letter from
// 'A' on, least first, between '<' and '>'. Encoders and motor words are counts without a unit. Every USB packet that
// comes in starts with two modem bytes of the FTDI bridge. Strict: what is not exactly a packet is none. Any thread; a
// few dozen instructions, no allocation. Source: libnifalcon/libnifalcon, FalconFirmwareNovintSDK.cpp,
// FalconCommLibUSB.cpp (facts; reference/devices 3.2). Never run against a real unit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace haptics {

inline constexpr std::uint16_t kFalconVendor = 0x0403, kFalconProduct = 0xCB48;
inline constexpr std::uint8_t kFalconIn = 0x81, kFalconOut = 0x02;
inline constexpr int kMaxFalconMotorWord = 4096;

using FalconPacket = std::array<std::uint8_t, 16>;

enum class FalconLights : std::uint8_t { none = 0, green = 2, blue = 4, red = 8 };

struct FalconCommand {
  std::array<int, 3> motor_words{};  ///< beyond +-4096 they are held there
  bool homing = true;                ///< counts encoders from the homing slots on; the public programs leave it on
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

/// What a bulk transfer carries without the two modem bytes at the head of each of its 64-byte packets. Returns how
/// many bytes it put into `payload`, which must be as long as `transfer`.
std::size_t ftdiPayload(std::span<const std::uint8_t> transfer, std::span<std::uint8_t> payload) noexcept;

/// Puts packets together from a stream that splits and spoils them where it likes; finds back after garbage.
class FalconStream {
 public:
  /// Of the bridge's payload. The newest packet that ends in it and can be decoded, if one does.
  std::optional<FalconPacket> take(std::span<const std::uint8_t> payload) noexcept;
  std::uint64_t rejected() const { return rejected_; }  ///< bytes that belonged to no packet

 private:
  void startAgain() noexcept;

  FalconPacket packet_{};
  std::size_t filled_ = 0;
  std::uint64_t rejected_ = 0;
};

}  // namespace haptics
