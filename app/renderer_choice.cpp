#include "app/renderer_choice.h"

#include <cstdio>
#include <string>

#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"

namespace app {
namespace {

using render::Backend;

void say(const std::string& words) { std::fprintf(stderr, "molar: drawing %s\n", words.c_str()); }

Backend byCard(std::optional<Backend> asked) {
  const render::GraphicsCard card = render::currentGraphicsCard();
  if (!asked && card.is_software) {
    say("on the CPU: no graphics card, OpenGL is " + card.name);
    return Backend::cpu;
  }
  if (!asked) say("with OpenGL on " + card.name);
  return asked.value_or(Backend::gl_fragment);
}

}  // namespace

Backend rendererWithoutWindow(std::optional<Backend> asked, std::optional<render::OffscreenContext>& context) {
  if (asked == Backend::cpu) return Backend::cpu;
  try {
    context.emplace();
  } catch (const render::GpuError&) {
    if (asked) throw;
    say("on the CPU: there is no OpenGL 4.5");
    return Backend::cpu;
  }
  const Backend backend = byCard(asked);
  if (backend == Backend::cpu) context.reset();
  return backend;
}

Backend rendererForWindow(std::optional<Backend> asked) { return asked == Backend::cpu ? Backend::cpu : byCard(asked); }

}  // namespace app
