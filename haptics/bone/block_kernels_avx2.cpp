// Compiled for AVX2; see CMakeLists.txt.
#define MOLAR_KERNEL_SET avx2
#include "haptics/bone/block_kernels_body.h"
