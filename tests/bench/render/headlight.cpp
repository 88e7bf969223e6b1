#include "tests/bench/render/headlight.h"

namespace bench {

void headlight(const HeadlightJob& job, [[maybe_unused]] assets::InstructionSet set) {
#if defined(__x86_64__)
  if (set == assets::InstructionSet::avx512) return avx512::headlight(job);
  if (set == assets::InstructionSet::avx2) return avx2::headlight(job);
#endif
  portable::headlight(job);
}

}  // namespace bench
