#include "app/commands/shown_import.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <future>
#include <optional>
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

/// The window while it works.
class ShownCourse {
 public:
  ShownCourse(CheckWindow& window, ImportCourse& course) : window_(window), course_(course) {}

  /// Takes what the hand did, and draws where that is due.
  void step() {
    for (const render::WindowEvent& event : window_.takeEvents()) {
      if (const auto* const moved = std::get_if<render::PointerMoved>(&event)) pointer_px_ = moved->to_px;
      if (const auto* const wheel = std::get_if<render::WheelTurned>(&event)) turn(wheel->notches);
      // As Ctrl+C.
      if (isCancel(event, pointer_px_, window_.size_px())) ::kill(::getpid(), SIGINT);
    }
    const auto now = std::chrono::steady_clock::now();
    if (now < due_) return;
    due_ = now + kDrawnEvery;
    window_.show([this](glm::ivec2 px) {
      drawSlices(px);
      return importPage(
          course_.stages(), course_.now_s(),
          {"Importing a scan", "What names a person is left out; jaw, teeth and canals are looked for.", true}, px,
          slices_ ? &*slices_ : nullptr);
    });
  }

 private:
  void turn(double notches) {
    const auto boxes = importViewBoxes(window_.size_px());
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      const glm::dvec2 inside = pointer_px_ - glm::dvec2(boxes[n].corner_px);
      if (glm::all(glm::greaterThanEqual(inside, glm::dvec2(0.0))) &&
          glm::all(glm::lessThan(inside, glm::dvec2(boxes[n].size_px))))
        course_.view().turn(static_cast<ImportView::Slice>(n), notches);
    }
  }
  /// Where they differ from those that are shown.
  void drawSlices(glm::ivec2 px) {
    const std::uint64_t changes = course_.view().changes();
    if (changes == drawn_changes_ && px == drawn_px_) return;
    drawn_changes_ = changes, drawn_px_ = px;
    const auto boxes = importViewBoxes(px);
    slices_.reset();
    if (boxes[0].size_px.x > 0)
      slices_ = course_.view().pictures({boxes[0].size_px, boxes[1].size_px, boxes[2].size_px});
  }

  static constexpr std::chrono::milliseconds kDrawnEvery{100};

  CheckWindow& window_;
  ImportCourse& course_;
  glm::dvec2 pointer_px_{-1.0};
  std::chrono::steady_clock::time_point due_{};
  std::uint64_t drawn_changes_ = 0;
  glm::ivec2 drawn_px_{0};
  std::optional<std::array<render::Image, ImportView::kSlices>> slices_;
};

}  // namespace

std::unique_ptr<CheckWindow> runShown(const std::function<void(ImportCourse&)>& work, bool in_window) {
  constexpr std::chrono::milliseconds kStepEvery{20}, kRefusedWithin{300};
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
  std::optional<ShownCourse> shown;
  if (window) shown.emplace(*window, course);
  constexpr int kStepsALine = 4;
  for (int step = 0; working.wait_for(kStepEvery) != std::future_status::ready; ++step) {
    if (step % kStepsALine == 0) course.drawLine();
    if (shown) shown->step();
  }
  working.get();
  // Too late to undo it, early enough not to go on.
  return signals.isAsked() ? nullptr : std::move(window);
}

}  // namespace app
