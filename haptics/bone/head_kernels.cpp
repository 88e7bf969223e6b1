#include "haptics/bone/head_kernels.h"

#include "haptics/bone/instruction_set.h"

namespace haptics {

// Not by pointers: what the servo can reach must be plain to see.
void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept {
#if defined(__x86_64__)
  if (chosenInstructionSet() == InstructionSet::avx512) return avx512::coverUnderHead(head, first, fraction);
  if (chosenInstructionSet() == InstructionSet::avx2) return avx2::coverUnderHead(head, first, fraction);
#endif
  portable::coverUnderHead(head, first, fraction);
}

HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept {
#if defined(__x86_64__)
  if (chosenInstructionSet() == InstructionSet::avx512) return avx512::sumUnderHead(head, block);
  if (chosenInstructionSet() == InstructionSet::avx2) return avx2::sumUnderHead(head, block);
#endif
  return portable::sumUnderHead(head, block);
}

}  // namespace haptics
