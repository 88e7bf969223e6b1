// Composes the eye images into the outputs of a display, sRGB-encoded once: twin of output.frag without OpenGL. Which
// eye a pixel shows: display/stereo_layout.h. Any thread; about 1 ms for 640x480 on one core, rows in parallel in the
// caller's arena.
#pragma once

#include "render/cpu/eye_image.h"
#include "render/cpu/shade_kernels.h"
#include "render/display/overlay.h"
#include "render/display/stereo_layout.h"
#include "render/image.h"

namespace render {

/// `left` is the cyclopean eye in mono. Images smaller than their area are scaled bilinearly.
void compose(const StereoLayout& layout, const EyeImage& left, const EyeImage& right, const ShadeKernels& kernels,
             Image& output);

/// Over a composed output; about 2 ns a pixel of the patch.
void blendOver(const OverlayPatch& patch, Image& output);

}  // namespace render
