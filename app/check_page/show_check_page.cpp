#include "app/check_page/show_check_page.h"

#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "app/check_page/check_run.h"
#include "app/check_page/import_page.h"
#include "assets/patient/patient_folder.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kEventInterval{10}, kProgressInterval{150};

bool isToLeave(const render::WindowEvent& event) {
  const auto* const key = std::get_if<render::KeyPressed>(&event);
  return std::holds_alternative<render::CloseRequested>(event) ||
         (key != nullptr && key->down && key->key == render::Key::escape);
}

/// None: it was left meanwhile.
std::unique_ptr<CheckRun> openedIn(CheckWindow& window, const std::string& folder, const ReportLine& report) {
  // On a whole jaw, two busy cores.
  constexpr double kUsual_s = 8.0;
  auto opening = std::async(std::launch::async, [&] { return std::make_unique<CheckRun>(folder, report); });
  const Clock::time_point begun = Clock::now();
  ImportStages stages({{.name = "opening", .usual_s = kUsual_s}});
  stages.begin("opening", 0.0);
  bool is_left = false;
  auto shown = begun - kProgressInterval;
  while (opening.wait_for(kEventInterval) != std::future_status::ready) {
    for (const render::WindowEvent& event : window.takeEvents()) is_left = is_left || isToLeave(event);
    if (Clock::now() - shown < kProgressInterval) continue;
    shown = Clock::now();
    window.show([&](glm::ivec2 px) {
      return importPage(
          stages, std::chrono::duration<double>(shown - begun).count(),
          {is_left ? "Leaving" : "Opening the patient", "Volume, slices and teeth are made ready.", false}, px);
    });
  }
  std::unique_ptr<CheckRun> run = opening.get();
  return is_left ? nullptr : std::move(run);
}

}  // namespace

void showCheckPage(const std::string& folder, const ReportLine& report) {
  // What is no patient is said before a window opens.
  assets::describedPatient(folder);
  CheckWindow window("Molar: check", report);
  showCheckPage(window, folder, report);
}

void showCheckPage(CheckWindow& window, const std::string& folder, const ReportLine& report) {
  const std::unique_ptr<CheckRun> run = openedIn(window, folder, report);
  if (!run) return;
  glm::ivec2 shown_px{0};
  auto shown = Clock::now() - kProgressInterval;
  for (;;) {
    const glm::ivec2 px = window.size_px();
    bool was_touched = false;
    for (const render::WindowEvent& event : window.takeEvents()) {
      if (!run->handle(event, px)) return;
      was_touched = true;
    }
    run->step();
    // Progress by itself needs no more than a few pictures a second.
    const bool is_due = Clock::now() - shown > kProgressInterval;
    if (((was_touched || is_due) && run->takeChanged()) || px != shown_px) {
      window.show([&run](glm::ivec2 size_px) { return run->picture(size_px); });
      shown_px = px, shown = Clock::now();
    }
    std::this_thread::sleep_for(kEventInterval);
  }
}

}  // namespace app
