#include "app/doctor/checks.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"
#include "render/gpu/offscreen_context.h"

namespace app {

std::optional<GraphicsFacts> probeGraphics() {
  try {
    const render::OffscreenContext context;
    const render::GraphicsCard card = render::currentGraphicsCard();
    return GraphicsFacts{card.version, card.name, card.is_software};
  } catch (const render::GpuError&) {
    return {};
  }
}

Finding checkGraphics(const std::optional<GraphicsFacts>& facts) {
  Finding finding{"graphics", Health::missing, "No OpenGL 4.5 can be had on this machine.",
                  "Install the driver of your graphics card; without a card: sudo apt install libegl1 libgl1-mesa-dri"};
  if (!facts) return finding;
  finding.sentence = "OpenGL " + facts->version + " by " + facts->card + (facts->is_software ? ", on the CPU." : ".");
  finding.health = facts->is_software ? Health::warn : Health::ok;
  finding.next_step =
      facts->is_software ? "It draws, slowly: a graphics card with its driver makes the picture smooth." : "";
  return finding;
}

}  // namespace app
