// The scene in OpenGL 4.5: order per eye background, opaque meshes, volume, transparent meshes, in linear light; the
// output pass encodes sRGB. Needs a current context that outlives it. Render thread.
#pragma once

#include <memory>

#include "render/render_options.h"
#include "render/scene_renderer.h"

namespace render {

/// `solid` and `label` in the order of `grid`; label may be empty. Throws GpuError.
std::unique_ptr<SceneRenderer> glSceneRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                               std::span<const std::uint8_t> label, const RenderOptions& options);

}  // namespace render
