// Vector instruction set of this machine, determined once before main. The kernels of haptics and render/cpu are
// compiled once per set and select by it; it stands here because both folders may include it. Any thread; one load.
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

/// The best available set, or a lower one named by the environment variable MOLAR_INSTRUCTIONS (portable, avx2).
InstructionSet chosenInstructionSet() noexcept;

}  // namespace assets
