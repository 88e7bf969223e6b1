// For every machine.
#define MOLAR_KERNEL_SET portable
#include "haptics/bone/block_kernels_body.h"
