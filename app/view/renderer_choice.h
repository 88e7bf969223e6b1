// Selects the renderer: as requested, else OpenGL with a graphics card, and the CPU where OpenGL is a software
// rasteriser. Reports an automatic choice in one line. Start-up only.
#pragma once

#include <optional>

#include "app/text/message.h"
#include "render/gpu/offscreen_context.h"
#include "render/render_options.h"

namespace app {

/// `requested`: empty for automatic choice. Makes the context the renderer needs. Throws GpuError if OpenGL was
/// requested but is not available.
render::Backend rendererWithoutWindow(std::optional<render::Backend> requested,
                                      std::optional<render::OffscreenContext>& context, const ReportLine& report);

/// With the window's context current.
render::Backend rendererForWindow(std::optional<render::Backend> requested, const ReportLine& report);

}  // namespace app
