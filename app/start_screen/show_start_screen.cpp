#include "app/start_screen/show_start_screen.h"

#include <chrono>
#include <cmath>
#include <thread>
#include <variant>

#include "app/start_screen/start_page.h"
#include "app/view/display_windows.h"
#include "app/view/page_screen.h"

namespace app {
namespace {

constexpr glm::ivec2 kStartWindow_px{1280, 800};
constexpr std::chrono::milliseconds kEventInterval{15};

}  // namespace

bool showStartScreen(StartMenu& menu, const ReportLine& report) {
  DisplayWindows windows({.screen_px = kStartWindow_px}, report);
  PageScreen screen(windows, kStartWindow_px, false);
  glm::dvec2 pointer_px{-1.0};
  glm::ivec2 shown_px{0};
  bool changed = true;
  const auto answer_to = [&](const render::WindowEvent& event) {
    if (std::holds_alternative<render::CloseRequested>(event)) return StartMenu::Answer::leave;
    if (const auto* const moved = std::get_if<render::PointerMoved>(&event)) pointer_px = moved->to_px;
    if (const auto* const key = std::get_if<render::KeyPressed>(&event)) {
      changed = true;
      return menu.take(*key);
    }
    if (const auto* const wheel = std::get_if<render::WheelTurned>(&event)) {
      const auto over = startPlaceAt(menu, pointer_px, windows.first().framebufferSize_px());
      if (over && !over->starts) menu.scroll(over->list, -static_cast<int>(std::lround(wheel->notches)));
      changed = true;
      return StartMenu::Answer::none;
    }
    const auto* const button = std::get_if<render::ButtonPressed>(&event);
    if (button == nullptr || !button->down || button->button != render::MouseButton::left)
      return StartMenu::Answer::none;
    const auto place = startPlaceAt(menu, pointer_px, windows.first().framebufferSize_px());
    if (!place) return StartMenu::Answer::none;
    changed = true;
    if (place->starts) return menu.start();
    menu.choose(place->list, place->choice);
    return StartMenu::Answer::none;
  };
  for (;;) {
    for (const render::WindowEvent& event : windows.takeEvents())
      if (const StartMenu::Answer answer = answer_to(event); answer != StartMenu::Answer::none)
        return answer == StartMenu::Answer::start;
    const glm::ivec2 px = windows.first().framebufferSize_px();
    if (changed || px != shown_px)
      screen.show([&](const render::StereoLayout& layout) { return startPage(menu, layout.screen_px); });
    changed = false, shown_px = px;
    std::this_thread::sleep_for(kEventInterval);
  }
}

}  // namespace app
