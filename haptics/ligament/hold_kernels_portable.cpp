// For every machine.
#define MOLAR_KERNEL_SET portable
#include "haptics/ligament/blade_kernels_body.h"
#include "haptics/ligament/hold_kernels_body.h"
