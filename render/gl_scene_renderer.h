// The scene in OpenGL 4.5: order per eye background, opaque meshes, volume, transparent meshes, in linear light; the
// output pass encodes sRGB. Needs a current context that outlives it. Render thread.
#pragma once

#include <memory>

#include "render/render_options.h"
#include "render/scene_renderer.h"

namespace render {

/// Throws GpuError.
std::unique_ptr<SceneRenderer> glSceneRenderer(const VolumeFields& fields, const RenderOptions& options);

}  // namespace render
