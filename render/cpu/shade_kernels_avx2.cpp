#include "render/cpu/shade_kernel_body.h"
#include "render/cpu/shade_kernel_tables.h"

namespace render {

const ShadeKernels kShadeKernelsAvx2 = cpu::kShadeKernels;

}  // namespace render
