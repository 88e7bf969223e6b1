// `molar display`: test patterns for the technician, on the display or as an image; list of monitors.

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/core.h>

#include "app/commands/command.h"
#include "app/options/display_option.h"
#include "app/options/settings_text.h"
#include "app/options/view_option.h"
#include "app/pattern/test_pattern.h"
#include "app/station/rig_choice.h"
#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/display_windows.h"
#include "app/view/snapshot.h"
#include "calibration/output_file.h"
#include "calibration/record/utc.h"
#include "render/gpu/window_image.h"

namespace app {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(30);

volatile std::sig_atomic_t interrupted = 0;

struct DisplayOptions {
  DisplayOption display;
  RigOption rig;
  std::string pattern = "eyes", size, out;
  std::optional<int> monitor;
  std::optional<double> seconds;
  bool monitors = false, windowed = false, force = false;
};

int listMonitors() {
  int n = 0;
  for (const render::Monitor& monitor : render::monitors())
    std::fputs(fmt::format("{}  {}  {}x{} at {},{}  {:.0f} Hz\n", ++n, monitor.name, monitor.px.x, monitor.px.y,
                           monitor.at_px.x, monitor.at_px.y, monitor.refresh_Hz)
                   .c_str(),
               stdout);
  return 0;
}

calibration::Rig rigOf(const DisplayOptions& options) {
  calibration::Rig rig;
  if (options.rig.isGiven()) {
    rig = options.rig.choose({}, calibration::nowUtc())->record.rig;
    if (!options.size.empty()) rig.screen.px = imageSize(options.size);
  } else {
    rig = calibration::desktopRig(options.size.empty() ? glm::ivec2(1920, 1080) : imageSize(options.size));
  }
  options.display.refuseUnlessFits(rig);
  return rig;
}

/// The pattern in the windows of a display, drawn again when pattern, window size or window position changes.
class PatternShow {
 public:
  PatternShow(const DisplayOptions& options, const calibration::Rig& rig)
      : rig_(rig),
        swapped_(options.display.swapped()),
        pattern_(*testPatternNamed(options.pattern)),
        windows_({.mode = options.display.mode(),
                  .screen_px = rig.screen.px,
                  .full_screen = !options.windowed,
                  .monitor = options.monitor ? std::optional(*options.monitor - 1) : std::nullopt},
                 printMessage) {}

  void run(std::optional<double> seconds) {
    const auto begun = std::chrono::steady_clock::now();
    while (!over_ && !interrupted &&
           !(seconds && std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() > *seconds)) {
      for (const render::WindowEvent& event : windows_.takeEvents()) take(event);
      drawIfChanged();
      windows_.fill([this](const render::WindowTarget& place, int output) {
        upload_[output].show(outputs_[static_cast<std::size_t>(output)], place);
      });
      windows_.first().present();
      std::this_thread::sleep_for(kInterval);
    }
  }

 private:
  void take(const render::WindowEvent& event) {
    if (std::holds_alternative<render::CloseRequested>(event)) over_ = true;
    const auto* key = std::get_if<render::KeyPressed>(&event);
    if (key == nullptr || !key->down || key->repeated) return;
    if (key->key == render::Key::escape) over_ = true;
    const int count = static_cast<int>(kTestPatterns.size());
    int now = static_cast<int>(pattern_);
    if (key->key == render::Key::right || key->key == render::Key::space) ++now;
    if (key->key == render::Key::left) now += count - 1;
    pattern_ = kTestPatterns[static_cast<std::size_t>(now % count)].pattern;
  }

  /// In window pixels, so that lines of one pixel stay sharp.
  void drawIfChanged() {
    const glm::ivec2 window_px = windows_.first().framebufferSize_px();
    if (window_px.x <= 0 || window_px.y <= 0) return;
    render::StereoLayout layout{
        .mode = windows_.mode(), .screen_px = rig_.screen.px, .at_px = {0, 0}, .swapped = swapped_};
    if (render::outputSize(layout.mode, window_px) == window_px) layout.screen_px = window_px;
    if (render::isInterleaved(layout.mode)) layout.at_px = windows_.first().positionOnPanel_px();
    if (!outputs_.empty() && pattern_ == drawn_ && layout.screen_px == drawn_layout_.screen_px &&
        layout.at_px == drawn_layout_.at_px)
      return;
    drawn_ = pattern_;
    drawn_layout_ = layout;
    outputs_.clear();
    for (layout.output = 0; layout.output < render::outputCount(layout.mode); ++layout.output)
      outputs_.push_back(patternOutput(pattern_, rig_, layout));
  }

  calibration::Rig rig_;
  bool swapped_;
  TestPattern pattern_, drawn_ = TestPattern::eyes;
  render::StereoLayout drawn_layout_;
  std::vector<render::Image> outputs_;
  DisplayWindows windows_;
  render::WindowUpload upload_[2];  // textures: destroyed before the windows
  bool over_ = false;
};

int display(const DisplayOptions& options) {
  if (options.monitors) return listMonitors();
  if (!testPatternNamed(options.pattern))
    throw UsageError("--pattern " + options.pattern + ": not a pattern, choose one of " +
                     joined(kTestPatterns, &TestPatternName::name));
  const calibration::Rig rig = rigOf(options);
  if (options.out.empty()) {
    std::signal(SIGINT, [](int) { interrupted = 1; });
    PatternShow(options, rig).run(options.seconds);
    return 0;
  }
  refuseUnlessPng("--out", options.out);
  if (render::outputCount(options.display.mode()) > 1)
    throw UsageError("--out: " + std::string(render::nameOf(options.display.mode())) +
                     " has two outputs, choose a display with one");
  calibration::OutputFile file(options.out, options.force);
  savePng(
      patternOutput(*testPatternNamed(options.pattern), rig,
                    {.mode = options.display.mode(), .screen_px = rig.screen.px, .swapped = options.display.swapped()}),
      file);
  return 0;
}

}  // namespace

void addDisplay(CommandLine& molar) {
  auto o = std::make_shared<DisplayOptions>();
  CommandLine& command = molar.command("display", "Test patterns on the display, until Esc; list of monitors");
  command
      .option("--pattern", o->pattern,
              joined(kTestPatterns, &TestPatternName::name) + "; right and left arrow change it")
      .showsDefault();
  o->rig.addTo(command, false);
  o->display.addTo(command);
  command.option("--monitor", o->monitor, "Monitor, from 1; two windows use the next one as well").wholeFrom(1, 16);
  command.option("--size", o->size, "Pixels of the screen").valueNamed("WxH");
  command.flag("--windowed", o->windowed, "In a window instead of the full screen");
  command.option("--seconds", o->seconds, "End after this time").from(0.1, 86400.0);
  command.option("--out", o->out, "Write an image instead, .png").valueNamed("FILE");
  command.flag("--force", o->force, "Replace an output that exists");
  command.flag("--monitors", o->monitors, "List the monitors and do nothing else");
  command.does([o] { return display(*o); });
}

}  // namespace app
