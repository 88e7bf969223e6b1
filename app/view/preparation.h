// Long work before a rehearsal, done on a thread of its own while the surgeon's windows show what is prepared and how
// far it is. Esc or closing the window cancels. On a terminal one line shows the same. Main thread.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/view/display_windows.h"
#include "assets/progress.h"
#include "calibration/rig.h"
#include "render/display/stereo_layout.h"
#include "render/image.h"

namespace app {

/// Seen by the rig's eyes, upright through its mirror. `share` 0..1.
render::Image preparationPage(const calibration::Rig& rig, const render::StereoLayout& layout, const std::string& what,
                              double share);

struct PreparationOptions {
  DisplayWindows::Options windows = {};
  bool eyes_swapped = false;
  bool headless = false;
  bool needs_window = true;  ///< throws if none can be opened
};

class Preparation {
 public:
  /// Borrows the rig.
  Preparation(const PreparationOptions& options, const calibration::Rig& rig, std::string what,
              const ReportLine& report);
  ~Preparation();

  /// The result of `work`, none if cancelled. Begins it, opens the windows meanwhile and shows the first page; once.
  /// Throws what the work throws, and GpuError. After a cancellation it waits until the work has noticed, which ends at
  /// its next report; its first is to come soon.
  template <class Result>
  std::optional<Result> run(const std::function<Result(const assets::ReportProgress&)>& work) {
    std::optional<Result> result;
    const bool done = runUntilDone([&](const assets::ReportProgress& report) { result.emplace(work(report)); });
    return done ? std::move(result) : std::nullopt;
  }

  /// Still showing the page; null without windows.
  std::unique_ptr<DisplayWindows> takeWindows() { return std::move(windows_); }

 private:
  struct Screen;

  void openWindows();
  bool runUntilDone(const std::function<void(const assets::ReportProgress&)>& work);
  void showPage(double share);
  void showLine(double share);
  bool isCancelled();

  PreparationOptions options_;
  calibration::Rig rig_;
  std::string what_;
  ReportLine report_;
  std::unique_ptr<DisplayWindows> windows_;
  std::unique_ptr<Screen> screen_;
  std::string shown_on_page_, shown_on_line_;  ///< percentages
};

}  // namespace app
