#include "app/view/renderer_choice.h"

#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"

namespace app {
namespace {

using render::Backend;

Backend byCard(std::optional<Backend> asked, const ReportLine& report) {
  const render::GraphicsCard card = render::currentGraphicsCard();
  if (!asked && card.is_software) {
    report("drawing on the CPU: no graphics card, OpenGL is " + card.name);
    return Backend::cpu;
  }
  if (!asked) report("drawing with OpenGL on " + card.name);
  return asked.value_or(Backend::gl_fragment);
}

}  // namespace

Backend rendererWithoutWindow(std::optional<Backend> asked, std::optional<render::OffscreenContext>& context,
                              const ReportLine& report) {
  if (asked == Backend::cpu) return Backend::cpu;
  try {
    context.emplace();
  } catch (const render::GpuError&) {
    if (asked) throw;
    report("drawing on the CPU: there is no OpenGL 4.5");
    return Backend::cpu;
  }
  const Backend backend = byCard(asked, report);
  if (backend == Backend::cpu) context.reset();
  return backend;
}

Backend rendererForWindow(std::optional<Backend> asked, const ReportLine& report) {
  return asked == Backend::cpu ? Backend::cpu : byCard(asked, report);
}

}  // namespace app
