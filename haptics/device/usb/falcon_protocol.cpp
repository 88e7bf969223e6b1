#include "haptics/device/usb/falcon_protocol.h"

#include <algorithm>
#include <cassert>

namespace haptics {
namespace {

constexpr std::uint8_t kBegin = '<', kEnd = '>', kZero = 'A';
constexpr std::size_t kUsbPacket = 64, kModemBytes = 2;

std::uint8_t letter(unsigned nibble) { return static_cast<std::uint8_t>(kZero + nibble); }

}  // namespace

FalconPacket encoded(const FalconCommand& command) noexcept {
  FalconPacket packet;
  packet.front() = kBegin;
  packet.back() = kEnd;
  for (std::size_t motor = 0; motor < 3; ++motor) {
    const int word = std::clamp(command.motor_words[motor], -kMaxFalconMotorWord, kMaxFalconMotorWord);
    const unsigned bits = static_cast<unsigned>(word) & 0xFFFFu;
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
      packet[1 + 4 * motor + nibble] = letter(bits >> (4 * nibble) & 0xFu);
  }
  packet[13] = letter(static_cast<unsigned>(command.lights) | (command.homing ? 1u : 0u));
  packet[14] = letter(0);
  return packet;
}

std::optional<FalconReport> decodeFalconReport(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() != 16 || bytes[0] != kBegin || bytes[15] != kEnd) return std::nullopt;
  FalconReport report;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    unsigned word = 0;
    for (std::size_t nibble = 0; nibble < 4; ++nibble) {
      const int value = bytes[1 + 4 * leg + nibble] - kZero;
      if (value < 0 || value > 15) return std::nullopt;
      word |= static_cast<unsigned>(value) << (4 * nibble);
    }
    report.encoders[leg] = static_cast<std::int16_t>(word);
  }
  const int flags = bytes[13] - kZero;
  if (flags < 0 || flags > 0x7F) return std::nullopt;
  report.buttons = static_cast<std::uint8_t>(flags & 0x0F);
  report.homed = static_cast<std::uint8_t>(flags >> 4);
  return report;
}

std::size_t ftdiPayload(std::span<const std::uint8_t> transfer, std::span<std::uint8_t> payload) noexcept {
  assert(payload.size() >= transfer.size());
  std::size_t length = 0;
  while (transfer.size() > kModemBytes) {
    const auto packet = transfer.first(std::min(transfer.size(), kUsbPacket));
    for (std::uint8_t byte : packet.subspan(kModemBytes)) payload[length++] = byte;
    transfer = transfer.subspan(packet.size());
  }
  return length;
}

std::optional<FalconPacket> FalconStream::take(std::span<const std::uint8_t> payload) noexcept {
  std::optional<FalconPacket> newest;
  for (std::uint8_t byte : payload) {
    if (filled_ == 0 && byte != kBegin) {
      ++rejected_;
      continue;
    }
    packet_[filled_++] = byte;
    if (filled_ < packet_.size()) continue;
    if (decodeFalconReport(packet_)) {
      newest = packet_;
      filled_ = 0;
    } else {
      startAgain();
    }
  }
  return newest;
}

void FalconStream::startAgain() noexcept {
  // At the next byte that may begin a packet.
  const auto next = std::find(packet_.begin() + 1, packet_.end(), kBegin);
  rejected_ += static_cast<std::uint64_t>(next - packet_.begin());
  filled_ = static_cast<std::size_t>(std::copy(next, packet_.end(), packet_.begin()) - packet_.begin());
}

}  // namespace haptics
