#include "app/commands/shown_import.h"

#include <chrono>
#include <csignal>
#include <future>
#include <string>
#include <variant>

#include <unistd.h>

#include "app/check_page/import_page.h"
#include "app/commands/stop_signals.h"
#include "render/gpu/gpu_error.h"

namespace app {
namespace {

bool isCancel(const render::WindowEvent& event, const glm::dvec2& pointer_px, glm::ivec2 window_px) {
  const auto* const key = std::get_if<render::KeyPressed>(&event);
  const auto* const button = std::get_if<render::ButtonPressed>(&event);
  return std::holds_alternative<render::CloseRequested>(event) ||
         (key != nullptr && key->down && key->key == render::Key::escape) ||
         (button != nullptr && button->down && button->button == render::MouseButton::left &&
          isCancelAt(pointer_px, window_px));
}

void showCourse(CheckWindow& window, const ImportCourse& course, glm::dvec2& pointer_px) {
  for (const render::WindowEvent& event : window.takeEvents()) {
    if (const auto* const moved = std::get_if<render::PointerMoved>(&event)) pointer_px = moved->to_px;
    // As Ctrl+C.
    if (isCancel(event, pointer_px, window.size_px())) ::kill(::getpid(), SIGINT);
  }
  window.show([&course](glm::ivec2 px) {
    return importPage(
        course.stages(), course.now_s(),
        {"Importing a scan", "What names a person is left out; jaw, teeth and canals are looked for.", true}, px);
  });
}

}  // namespace

std::unique_ptr<CheckWindow> runShown(const std::function<void(ImportCourse&)>& work, bool in_window) {
  constexpr std::chrono::milliseconds kDrawnEvery{60}, kRefusedWithin{300};
  const StopSignals signals;
  ImportCourse course;
  const ImportStopper stopper(signals, course);
  auto working = std::async(std::launch::async, [&] { work(course); });
  std::unique_ptr<CheckWindow> window;
  // What is refused at once needs none.
  if (in_window && working.wait_for(kRefusedWithin) != std::future_status::ready) try {
      window = std::make_unique<CheckWindow>("Molar: import", [&course](const std::string& line) { course.say(line); });
    } catch (const render::GpuError& error) {
      course.say(std::string("no window: ") + error.what());
    }
  glm::dvec2 pointer_px{-1.0};
  while (working.wait_for(kDrawnEvery) != std::future_status::ready) {
    course.drawLine();
    if (window) showCourse(*window, course, pointer_px);
  }
  working.get();
  // Too late to undo it, early enough not to go on.
  return signals.isAsked() ? nullptr : std::move(window);
}

}  // namespace app
