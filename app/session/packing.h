// Ticks and commands as bytes for the session file: every field in the order of its struct, little-endian, doubles as
// their IEEE 754 bits, so a round trip is bit-exact on every machine. A run of ticks is stored plane by plane (the
// first byte of every tick, then the second byte of every tick, …), which is what makes neighbouring ticks compress.
// Any thread; O(bytes), allocates the result. Not the compression (compressed.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// Bytes of one packed tick and one packed command.
std::size_t packedTickBytes();
std::size_t packedCommandBytes();

std::vector<std::uint8_t> packTicks(std::span<const haptics::Tick> ticks);
/// Throws SessionError if `bytes` is no whole number of ticks.
std::vector<haptics::Tick> unpackTicks(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> packCommand(const haptics::Command& command);
/// Throws SessionError if `bytes` is not one command.
haptics::Command unpackCommand(std::span<const std::uint8_t> bytes);

}  // namespace app
