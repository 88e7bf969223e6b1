// Compiled for AVX512; see CMakeLists.txt.
#include "haptics/bone/head_kernels_body.h"

namespace haptics::avx512 {

void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept {
  cover(head, first, fraction);
}
HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept { return sum(head, block); }

}  // namespace haptics::avx512
