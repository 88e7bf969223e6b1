#include "haptics/bone/head_kernels.h"

#include "assets/instruction_set.h"

namespace haptics {

// Direct calls, so that tests/architecture/servo_symbols.cmake can follow them.
void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept {
#if defined(__x86_64__)
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx512)
    return avx512::coverUnderHead(head, first, fraction);
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx2)
    return avx2::coverUnderHead(head, first, fraction);
#endif
  portable::coverUnderHead(head, first, fraction);
}

HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept {
#if defined(__x86_64__)
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx512) return avx512::sumUnderHead(head, block);
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx2) return avx2::sumUnderHead(head, block);
#endif
  return portable::sumUnderHead(head, block);
}

}  // namespace haptics
