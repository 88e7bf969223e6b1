// For every machine.
#define MOLAR_KERNEL_SET portable
#include "haptics/ligament/hold_kernels_body.h"
