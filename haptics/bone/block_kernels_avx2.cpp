// Compiled for AVX2; see CMakeLists.txt.
#include "haptics/bone/block_kernels_body.h"

namespace haptics {

const BlockKernels kBlockKernelsAvx2 = {cover, meets, step, digestOf};

}  // namespace haptics
