// For every machine.
#define MOLAR_KERNEL_SET portable
#include "haptics/bone/head_kernels_body.h"
