#include <fmt/core.h>

#include "app/doctor/checks.h"
#include "render/display/window.h"
#include "render/gpu/gpu_error.h"

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

}  // namespace app
