// The scene on the CPU alone: no OpenGL, no window, no graphics card. Rays in tiles of 16x16 pixels shared out over
// threads; meshes through Embree, tooth and bone by castSurface, light by the shading kernels. Draws what the OpenGL
// back-ends draw, within 2/255 but for edge pixels, and the same bits whatever the number of threads. A window can show
// its outputs if whoever owns OpenGL hands in a way to (RenderOptions needs none otherwise). Render thread.
#pragma once

#include <functional>
#include <memory>

#include "render/render_options.h"
#include "render/scene_renderer.h"

namespace render {

/// Brings a picture into the current window: its pixels, and where in it.
using ShowPicture = std::function<void(const Picture& picture, const WindowPlace& place)>;

/// `solid` and `label` in the order of `grid`; label may be empty. Throws GpuError.
std::unique_ptr<SceneRenderer> cpuSceneRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                                std::span<const std::uint8_t> label, const RenderOptions& options,
                                                ShowPicture show);

}  // namespace render
