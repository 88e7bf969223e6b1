// A piece of sound on its way from the microphone to who writes it. Plain; copied through a ring.
#pragma once

#include <array>
#include <cstdint>

namespace app {

struct HeardBlock {
  static constexpr std::size_t kMost = 128;

  std::array<float, kMost> samples{};  ///< -1..1
  std::uint32_t count = 0;
  bool overrun = false;    ///< some before these were lost in the card, nobody knows how many
  std::uint64_t lost = 0;  ///< so many before these were lost here
  std::int64_t t_ns = 0;   ///< all of them had arrived; 0: told with a later block
};

}  // namespace app
