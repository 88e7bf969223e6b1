// For every machine.
#include "haptics/bone/block_kernels_body.h"

namespace haptics::portable {

void coverBlock(const BlockUnderBur& at, std::uint16_t* coverage, std::uint32_t* exposure) noexcept {
  cover(at, coverage, exposure);
}
bool meetsBlock(const std::uint8_t* solid, const std::uint16_t* coverage) noexcept { return meets(solid, coverage); }
void stepBlock(BlockStep& block) noexcept { step(block); }
BlockDigest blockDigest(const std::uint8_t* solid, const std::uint8_t* reach, const std::uint16_t* dose) noexcept {
  return digestOf(solid, reach, dose);
}

}  // namespace haptics::portable
