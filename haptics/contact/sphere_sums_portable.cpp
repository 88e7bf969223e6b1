// For every machine.
#include "haptics/contact/sphere_sums_kernel.h"

namespace haptics {

void sphereSumsPortable(const SphereSumsInput& in, SphereSums& out) noexcept { sumSphere(in, out); }

}  // namespace haptics
