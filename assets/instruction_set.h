// Which vector instructions the machine has, asked once before main. The kernels of haptics and of render/cpu are
// compiled once for each and choose by this: no asset, but what both may include. Any thread; a load.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace assets {

enum class InstructionSet : std::uint8_t { portable, avx2, avx512 };

constexpr std::string_view nameOf(InstructionSet set) noexcept {
  constexpr std::array<std::string_view, 3> kNames = {"portable", "avx2", "avx512"};
  return kNames[static_cast<std::size_t>(set)];
}

/// AVX2 with FMA; AVX-512 F, BW, DQ, VL.
bool available(InstructionSet set) noexcept;

/// The best available, or what the environment variable MOLAR_INSTRUCTIONS (portable, avx2) asks for, if available.
InstructionSet chosenInstructionSet() noexcept;

}  // namespace assets
