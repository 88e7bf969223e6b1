#include "app/view/preparation.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#include <variant>

#include <fmt/core.h>

#include "app/report/screen_page.h"
#include "app/report/stereo_picture.h"
#include "app/view/page_screen.h"
#include "render/gpu/gpu_error.h"

namespace app {
namespace {

using PreparationClock = std::chrono::steady_clock;

constexpr auto kLook = std::chrono::milliseconds(15);
/// A volume is read by a fork of this process (assets/scan/volume_reader.h), best before the graphics driver's threads
/// are there: until the first report, if it comes soon.
constexpr auto kLookForBeginning = std::chrono::milliseconds(1), kLongestBeginning = std::chrono::milliseconds(250);
constexpr auto kLineAfter = std::chrono::milliseconds(400);  ///< short work needs no line on the terminal

constexpr Ink kGround = inkOf(0x0d0f12), kWords = inkOf(0xe6e8ea), kQuietWords = inkOf(0x8d949c),
              kBar = inkOf(0x57b5e8), kTrack = inkOf(0x262a30);

constexpr const char* kThen = "Drawing the first picture";

/// Thrown out of the work by its next report.
struct WorkCancelled {};

std::string percentText(double share) { return fmt::format("{:.0f} %", 100.0 * std::clamp(share, 0.0, 1.0)); }

}  // namespace

struct Preparation::Screen : PageScreen {
  using PageScreen::PageScreen;
};

render::Image preparationPage(const calibration::Rig& rig, const render::StereoLayout& layout, const std::string& what,
                              double share) {
  const ScreenPage page(rig, render::eyeImageSize(layout.mode, layout.screen_px));
  // Lengths are shares of the page, so that a small and a large screen look alike.
  const glm::dvec2 size = page.size_mm();
  const double unit = std::min(size.x, 1.6 * size.y) / 100.0;
  const double width = 46.0 * unit, height = 0.9 * unit, left = -0.5 * width;
  page.fill(kGround);
  page.text("Molar", {0.0, -7.0 * unit}, 5.6 * unit, kWords);
  page.box({left, 0.0}, {width, height}, kTrack);
  page.box({left, 0.0}, {width * std::clamp(share, 0.0, 1.0), height}, kBar);
  page.text(what, {left, 4.0 * unit}, 2.3 * unit, kWords, Align::left);
  page.text(percentText(share), {-left, 4.0 * unit}, 2.3 * unit, kWords, Align::right);
  page.text("Esc leaves", {0.0, 0.5 * size.y - 4.5 * unit}, 1.9 * unit, kQuietWords);
  const render::Image image = page.picture();
  return stereoPicture(image, image, layout);
}

Preparation::Preparation(const PreparationOptions& options, const calibration::Rig& rig, std::string what,
                         const ReportLine& report)
    : options_(options), rig_(rig), what_(std::move(what)), report_(report) {}

Preparation::~Preparation() = default;

void Preparation::openWindows() {
  if (options_.headless) return;
  try {
    windows_ = std::make_unique<DisplayWindows>(options_.windows, report_);
    screen_ = std::make_unique<Screen>(*windows_, options_.windows.screen_px, options_.eyes_swapped);
  } catch (const render::GpuError&) {
    // The display tries again, reports it and goes on without.
    if (options_.needs_window) throw;
  }
}

void Preparation::showPage(double share) {
  if (!screen_ || percentText(share) == shown_on_page_) return;
  shown_on_page_ = percentText(share);
  screen_->show([&](const render::StereoLayout& layout) { return preparationPage(rig_, layout, what_, share); });
}

/// Written over the one before.
void Preparation::showLine(double share) {
  if (percentText(share) == shown_on_line_) return;
  shown_on_line_ = percentText(share);
  std::fprintf(stderr, "\rmolar: %s … %s ", what_.c_str(), shown_on_line_.c_str());
}

bool Preparation::isCancelled() {
  if (!windows_) return false;
  for (const render::WindowEvent& event : windows_->takeEvents()) {
    const auto* const key = std::get_if<render::KeyPressed>(&event);
    if (std::holds_alternative<render::CloseRequested>(event) || (key && key->down && key->key == render::Key::escape))
      return true;
  }
  return false;
}

bool Preparation::runUntilDone(const std::function<void(const assets::ReportProgress&)>& work) {
  std::atomic<double> share{0.0};
  std::atomic<bool> begun{false}, cancelled{false}, over{false};
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      work([&](double now) {
        begun = true;
        if (cancelled) throw WorkCancelled();
        // Workers report in no order.
        for (double before = share; now > before && !share.compare_exchange_weak(before, now);) continue;
      });
    } catch (...) {
      failure = std::current_exception();
    }
    over = true;
  });

  const PreparationClock::time_point start = PreparationClock::now();
  const bool on_terminal = isatty(STDERR_FILENO) == 1;
  while (!begun && !over && PreparationClock::now() - start < kLongestBeginning)
    std::this_thread::sleep_for(kLookForBeginning);
  try {
    openWindows();
    showPage(share);
  } catch (...) {
    cancelled = true;
    worker.join();
    throw;
  }
  while (!over) {
    std::this_thread::sleep_for(kLook);
    if (!cancelled) cancelled = isCancelled();
    // The window goes at once, the work when it has noticed.
    if (cancelled) screen_.reset(), windows_.reset();
    showPage(share);
    if (on_terminal && PreparationClock::now() - start > kLineAfter) showLine(share);
  }
  worker.join();
  if (!shown_on_line_.empty()) std::fputs("\r\033[K", stderr);
  if (!cancelled && !failure) {
    // Stays until the first picture.
    what_ = kThen;
    shown_on_page_.clear();
    showPage(1.0);
  }
  screen_.reset();
  if (cancelled) return false;
  if (failure) std::rethrow_exception(failure);
  return true;
}

}  // namespace app
