// Compiled for AVX512; see CMakeLists.txt.
#define MOLAR_KERNEL_SET avx512
#include "haptics/ligament/blade_kernels_body.h"
#include "haptics/ligament/hold_kernels_body.h"
