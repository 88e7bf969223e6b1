// Compiled for AVX2; see CMakeLists.txt.
#include <immintrin.h>

#define MOLAR_KERNEL_SET avx2
#include "haptics/file/wall_kernels_body.h"
