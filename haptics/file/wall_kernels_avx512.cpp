// Compiled for AVX-512; see CMakeLists.txt.
#include <immintrin.h>

#define MOLAR_KERNEL_SET avx512
#include "haptics/file/wall_kernels_body.h"
