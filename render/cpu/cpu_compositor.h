// The eyes' canvases become the outputs of a display, sRGB-encoded once: the twin of output.frag without OpenGL. Which
// eye a pixel shows is said by display/stereo_layout.h alone. Any thread; about 1 ms for 640x480 on one core, rows are
// shared out over the threads of the caller's arena.
#pragma once

#include "render/cpu/eye_image.h"
#include "render/cpu/shade_kernels.h"
#include "render/display/stereo_layout.h"
#include "render/image.h"

namespace render {

/// `left` is the cyclopean eye in mono. Canvases smaller than their place are stretched bilinearly.
void compose(const StereoLayout& layout, const EyeImage& left, const EyeImage& right, const ShadeKernels& kernels,
             Image& output);

}  // namespace render
