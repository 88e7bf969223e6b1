// Compiled for AVX-512 F, BW, DQ, VL with FMA; see CMakeLists.txt.
#include <immintrin.h>

#include "haptics/contact/sphere_sums_kernel.h"

namespace haptics {

void sphereSumsAvx512(const SphereSumsInput& in, SphereSums& out) noexcept { sumSphere(in, out); }

}  // namespace haptics
