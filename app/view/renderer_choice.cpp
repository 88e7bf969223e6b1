#include "app/view/renderer_choice.h"

#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"

namespace app {
namespace {

using render::Backend;

Backend byCard(std::optional<Backend> asked, const TellLine& tell) {
  const render::GraphicsCard card = render::currentGraphicsCard();
  if (!asked && card.is_software) {
    tell("drawing on the CPU: no graphics card, OpenGL is " + card.name);
    return Backend::cpu;
  }
  if (!asked) tell("drawing with OpenGL on " + card.name);
  return asked.value_or(Backend::gl_fragment);
}

}  // namespace

Backend rendererWithoutWindow(std::optional<Backend> asked, std::optional<render::OffscreenContext>& context,
                              const TellLine& tell) {
  if (asked == Backend::cpu) return Backend::cpu;
  try {
    context.emplace();
  } catch (const render::GpuError&) {
    if (asked) throw;
    tell("drawing on the CPU: there is no OpenGL 4.5");
    return Backend::cpu;
  }
  const Backend backend = byCard(asked, tell);
  if (backend == Backend::cpu) context.reset();
  return backend;
}

Backend rendererForWindow(std::optional<Backend> asked, const TellLine& tell) {
  return asked == Backend::cpu ? Backend::cpu : byCard(asked, tell);
}

}  // namespace app
