#include "haptics/bone/block_kernels.h"

#include "haptics/bone/instruction_set.h"

namespace haptics {

const BlockKernels& blockKernels() noexcept {
#if defined(__x86_64__)
  if (chosenInstructionSet() != InstructionSet::portable) return kBlockKernelsAvx2;
#endif
  return kBlockKernelsPortable;
}

}  // namespace haptics
