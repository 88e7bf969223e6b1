// What leading somebody through a procedure on a display takes, whichever procedure it is: window, sounds, the stylus,
// and ways to leave. Main thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/calibrate/sounds.h"
#include "app/calibrate/stylus_source.h"
#include "app/calibrate/wizard_screen.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "haptics/device/haptic_device.h"

namespace app {

struct GuidedRun {
  haptics::HapticDevice* device = nullptr;            ///< opened, not started; null: practice
  std::optional<calibration::SyntheticRig> practice;  ///< what is practised on, where there is no device
  bool windows = true;                                ///< false: nothing is shown; the robot's only
  WizardDisplay display;
  bool sounds = true;
  std::function<void(const std::string& line)> tell = [](const std::string&) {};
  std::function<bool()> given_up = [] { return false; };  ///< asked many times a second: an interrupt
};

class GuidedProcedure {
 protected:
  using Clock = std::chrono::steady_clock;

  /// `robot`: it is led by itself. Throws UsageError where nobody could be led.
  GuidedProcedure(const GuidedRun& run, glm::ivec2 screen_px, bool robot);

  /// What a window tells, of a page seen through `rig`.
  void takeEvents(const calibration::Rig& rig);
  std::optional<TrueStylus> trueStylus() { return source_ ? source_->seen() : std::nullopt; }
  double shownFor_s() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

  std::optional<Sounds> sounds_;
  std::optional<WizardScreen> screen_;
  std::unique_ptr<StylusSource> source_;  ///< none yet, where a robot is led
  std::vector<StylusSample> samples_;
  WizardView view_;
  bool left_ = false;

 private:
  const GuidedRun& run_;
  Clock::time_point began_ = Clock::now();
};

}  // namespace app
