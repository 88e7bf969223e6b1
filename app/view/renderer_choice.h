// What draws the pictures: as asked, or by itself OpenGL where there is a graphics card and the CPU where OpenGL would
// be a program on the CPU too. Tells in a line what it chose. Start-up only.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "render/gpu/offscreen_context.h"
#include "render/render_options.h"

namespace app {

using ReportLine = std::function<void(const std::string& line)>;

/// `asked`: empty for the choice. Makes the context that the answer needs; GpuError if there is none though it was
/// asked for.
render::Backend rendererWithoutWindow(std::optional<render::Backend> asked,
                                      std::optional<render::OffscreenContext>& context, const ReportLine& report);

/// With the window's context current.
render::Backend rendererForWindow(std::optional<render::Backend> asked, const ReportLine& report);

}  // namespace app
