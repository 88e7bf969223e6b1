#include <fmt/core.h>

#include "app/doctor/checks.h"
#include "app/text/list.h"
#include "render/display/window.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"
#include "render/gpu/offscreen_context.h"

namespace app {
namespace {

constexpr double kSlowScreen_Hz = 59.0;

bool opensInQuadBuffer() {
  try {
    render::Window::Options options;
    options.size_px = {64, 64};
    options.visible = options.focused = false;
    options.quad_buffer = true;
    const render::Window window(options);
    return true;
  } catch (const render::GpuError&) {
    return false;
  }
}

}  // namespace

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

ScreenFacts probeScreens() {
  ScreenFacts facts;
  try {
    for (const render::Monitor& one : render::monitors())
      facts.screens.push_back({one.name, one.px.x, one.px.y, one.refresh_Hz});
  } catch (const render::GpuError&) {
    return facts;
  }
  facts.has_quad_buffer = opensInQuadBuffer();
  return facts;
}

Finding checkScreens(const ScreenFacts& facts) {
  if (facts.screens.empty())
    return {"displays", Health::missing, "There is no display: only molar rehearse --headless can run.",
            "Sign in at the machine's own screen, or set DISPLAY to a running X server."};
  Finding finding{"displays", Health::ok, ""};
  for (const ScreenFacts::Screen& one : facts.screens) {
    finding.sentence += finding.sentence.empty() ? "" : ", ";
    finding.sentence +=
        fmt::format("{} {} × {} px at {:.0f} Hz", one.name, one.width_px, one.height_px, one.refresh_Hz);
    if (one.refresh_Hz < kSlowScreen_Hz) {
      finding.health = Health::warn;
      finding.next_step = "Choose a mode of 60 Hz or more in the system's display settings.";
    }
  }
  finding.sentence += ".";
  return finding;
}

Finding checkStereo(const ScreenFacts& facts) {
  if (facts.screens.empty())
    return {"stereo", Health::not_needed, "Without a display there is nothing to see in stereo."};
  std::string ways = facts.has_quad_buffer ? "Quad-buffered stereo, " : "No quad-buffered stereo; ";
  ways += "side by side, top and bottom, by rows and anaglyph work on any display";
  ways += facts.screens.size() > 1 ? ", two windows on two of these." : ".";
  return {"stereo", Health::ok, ways, "molar display --pattern eyes shows which eye sees what."};
}

Finding checkSound(const Machine& machine) {
  // " 0 [PCH            ]: HDA-Intel - HDA Intel PCH", and a second line of detail.
  std::vector<std::string> cards;
  for (const std::string& line : linesOf(machine.proc / "asound/cards")) {
    const std::size_t name = line.find("]: ");
    if (name != std::string::npos) cards.push_back(line.substr(name + 3));
  }
  std::error_code none;
  const bool has_pipewire = std::filesystem::exists(machine.runtime / "pipewire-0", none);
  const bool has_pulse = std::filesystem::exists(machine.runtime / "pulse/native", none);
  const std::string server = has_pipewire ? "PipeWire" : has_pulse ? "PulseAudio" : "";
  if (cards.empty() && server.empty())
    return {"sound", Health::warn, "There is no sound card: the drill is felt and seen, not heard.",
            "Plug in a sound card or a headset if you want to hear it."};
  if (server.empty())
    return {"sound", Health::ok, joined(cards) + ", without a sound server: one program at a time.",
            "sudo apt install pipewire-audio shares it between programs."};
  return {"sound", Health::ok, (cards.empty() ? "No card of its own" : joined(cards)) + ", by " + server + "."};
}

}  // namespace app
