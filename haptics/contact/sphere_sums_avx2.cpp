// Compiled for AVX2 with FMA; see CMakeLists.txt.
#include <immintrin.h>

#include "haptics/contact/sphere_sums_kernel.h"

namespace haptics {

void sphereSumsAvx2(const SphereSumsInput& in, SphereSums& out) noexcept { sumSphere(in, out); }

}  // namespace haptics
