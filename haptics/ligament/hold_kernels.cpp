#include "haptics/ligament/hold_kernels.h"

#include "assets/instruction_set.h"

namespace haptics {

// Direct calls, so that tests/architecture/servo_symbols.cmake can follow them.
HoldSums sumHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place) noexcept {
#if defined(__x86_64__)
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx512) return avx512::sumHold(law, samples, place);
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx2) return avx2::sumHold(law, samples, place);
#endif
  return portable::sumHold(law, samples, place);
}

HoldAge ageHold(const HoldConstants& law, const HoldSamples& samples, const HoldPlace& place,
                const HoldMemory& memory) noexcept {
#if defined(__x86_64__)
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx512)
    return avx512::ageHold(law, samples, place, memory);
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx2) return avx2::ageHold(law, samples, place, memory);
#endif
  return portable::ageHold(law, samples, place, memory);
}

}  // namespace haptics
