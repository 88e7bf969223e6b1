#include "app/view/renderer_choice.h"

#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"

namespace app {
namespace {

using render::Backend;

Backend byCard(std::optional<Backend> requested, const ReportLine& report) {
  const render::GraphicsCard card = render::currentGraphicsCard();
  if (!requested && card.is_software) {
    report("drawing on the CPU: no graphics card, OpenGL is " + card.name);
    return Backend::cpu;
  }
  if (card.is_software)
    report("OpenGL is " + card.name +
           ", without a graphics card: the first picture takes long; --renderer cpu is faster");
  if (!requested) report("drawing with OpenGL on " + card.name);
  return requested.value_or(Backend::gl_fragment);
}

}  // namespace

Backend rendererWithoutWindow(std::optional<Backend> requested, std::optional<render::OffscreenContext>& context,
                              const ReportLine& report) {
  if (requested == Backend::cpu) return Backend::cpu;
  try {
    context.emplace();
  } catch (const render::GpuError&) {
    if (requested) throw;
    report("drawing on the CPU: there is no OpenGL 4.5");
    return Backend::cpu;
  }
  const Backend backend = byCard(requested, report);
  if (backend == Backend::cpu) context.reset();
  return backend;
}

Backend rendererForWindow(std::optional<Backend> requested, const ReportLine& report) {
  return requested == Backend::cpu ? Backend::cpu : byCard(requested, report);
}

}  // namespace app
