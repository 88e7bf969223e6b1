#include "app/check_page/show_check_page.h"

#include <chrono>
#include <thread>

#include "app/check_page/check_run.h"
#include "app/view/display_windows.h"
#include "app/view/page_screen.h"

namespace app {
namespace {

constexpr glm::ivec2 kCheckWindow_px{1280, 800};
constexpr std::chrono::milliseconds kEventInterval{10}, kProgressInterval{150};

}  // namespace

void showCheckPage(const std::string& folder, const ReportLine& report) {
  CheckRun run(folder, report);
  DisplayWindows windows({.screen_px = kCheckWindow_px}, report);
  windows.first().setTitle("Molar: check");
  PageScreen screen(windows, kCheckWindow_px, false);
  glm::ivec2 shown_px{0};
  auto shown = std::chrono::steady_clock::now() - kProgressInterval;
  for (;;) {
    const glm::ivec2 px = windows.first().framebufferSize_px();
    bool was_touched = false;
    for (const render::WindowEvent& event : windows.takeEvents()) {
      if (!run.handle(event, px)) return;
      was_touched = true;
    }
    run.step();
    // Progress by itself needs no more than a few pictures a second.
    const bool is_due = std::chrono::steady_clock::now() - shown > kProgressInterval;
    if (((was_touched || is_due) && run.takeChanged()) || px != shown_px) {
      screen.show([&](const render::StereoLayout& layout) { return run.picture(layout.screen_px); });
      shown_px = px, shown = std::chrono::steady_clock::now();
    }
    std::this_thread::sleep_for(kEventInterval);
  }
}

}  // namespace app
