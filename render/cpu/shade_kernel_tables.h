// The shading kernels of every instruction set, each defined by a file compiled for it. For shade_kernels.cpp alone.
#pragma once

#include "render/cpu/shade_kernels.h"

namespace render {

extern const ShadeKernels kShadeKernelsPortable, kShadeKernelsAvx2, kShadeKernelsAvx512;

}  // namespace render
