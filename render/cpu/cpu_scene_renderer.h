// The scene on the CPU alone: no OpenGL, no window, no graphics card. Rays in tiles of 16x16 pixels shared out over
// threads; meshes through Embree, tooth and bone by castSurface, light by the shading kernels. Draws what the OpenGL
// back-ends draw, within 2/255 but for edge pixels, and the same bits whatever the number of threads. Whoever
// owns OpenGL hands in the way into a window. Render thread.
#pragma once

#include <functional>
#include <memory>

#include "render/render_options.h"
#include "render/scene_renderer.h"

namespace render {

/// Brings a image into the current window: its pixels, and where in it.
using ShowImage = std::function<void(const Image& image, const WindowTarget& place)>;

/// Throws GpuError.
std::unique_ptr<SceneRenderer> cpuSceneRenderer(const VolumeFields& fields, const RenderOptions& options,
                                                ShowImage show);

}  // namespace render
