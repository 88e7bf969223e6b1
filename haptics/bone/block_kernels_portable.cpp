// For every machine.
#include "haptics/bone/block_kernels_body.h"

namespace haptics {

const BlockKernels kBlockKernelsPortable = {cover, meets, step, digestOf};

}  // namespace haptics
