// For every machine.
#include "haptics/bone/head_kernels_body.h"

namespace haptics::portable {

void coverUnderHead(const HeadShape& head, const float first[3], float* fraction) noexcept {
  cover(head, first, fraction);
}
HeadSums sumUnderHead(const HeadShape& head, const HeadBlock& block) noexcept { return sum(head, block); }

}  // namespace haptics::portable
