#include "haptics/bone/block_kernels.h"

#include "assets/instruction_set.h"

namespace haptics {

#if defined(__x86_64__)
namespace fastest = avx2;
#else
namespace fastest = portable;
#endif

// Direct calls, so that tests/architecture/servo_symbols.cmake can follow them.
namespace {
bool isFast() { return assets::chosenInstructionSet() != assets::InstructionSet::portable; }
}  // namespace

void coverBlock(const BlockUnderBur& at, std::uint16_t* coverage, std::uint32_t* exposure) noexcept {
  isFast() ? fastest::coverBlock(at, coverage, exposure) : portable::coverBlock(at, coverage, exposure);
}
bool meetsBlock(const std::uint8_t* solid, const std::uint16_t* coverage) noexcept {
  return isFast() ? fastest::meetsBlock(solid, coverage) : portable::meetsBlock(solid, coverage);
}
void stepBlock(BlockStep& block) noexcept { isFast() ? fastest::stepBlock(block) : portable::stepBlock(block); }
BlockDigest blockDigest(const std::uint8_t* solid, const std::uint8_t* reach, const std::uint16_t* dose) noexcept {
  return isFast() ? fastest::blockDigest(solid, reach, dose) : portable::blockDigest(solid, reach, dose);
}
std::uint16_t doseLeaving(std::uint8_t first, std::uint8_t left, std::uint32_t block_key,
                          std::uint32_t within) noexcept {
  return portable::doseLeaving(first, left, block_key, within);
}

}  // namespace haptics
