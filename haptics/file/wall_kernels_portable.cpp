// For every machine.
#define MOLAR_KERNEL_SET portable
#include "haptics/file/wall_kernels_body.h"
