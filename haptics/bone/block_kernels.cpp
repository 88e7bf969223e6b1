#include "haptics/bone/block_kernels.h"

#include "assets/instruction_set.h"

namespace haptics {

#if defined(__x86_64__)
namespace chosen = avx2;
#else
namespace chosen = portable;
#endif

// Not by pointers: what the servo can reach must be plain to see.
namespace {
bool fast() { return assets::chosenInstructionSet() != assets::InstructionSet::portable; }
}  // namespace

void coverBlock(const BlockUnderBur& at, std::uint16_t* coverage, std::uint32_t* exposure) noexcept {
  fast() ? chosen::coverBlock(at, coverage, exposure) : portable::coverBlock(at, coverage, exposure);
}
bool meetsBlock(const std::uint8_t* solid, const std::uint16_t* coverage) noexcept {
  return fast() ? chosen::meetsBlock(solid, coverage) : portable::meetsBlock(solid, coverage);
}
void stepBlock(BlockStep& block) noexcept { fast() ? chosen::stepBlock(block) : portable::stepBlock(block); }
BlockDigest blockDigest(const std::uint8_t* solid, const std::uint8_t* reach, const std::uint16_t* dose) noexcept {
  return fast() ? chosen::blockDigest(solid, reach, dose) : portable::blockDigest(solid, reach, dose);
}

}  // namespace haptics
