// Common parts of the guided procedures on a display: window, sounds, stylus, and ways to leave. Main thread.
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
  haptics::HapticDevice* device = nullptr;            ///< open, not started; null: practice
  std::optional<calibration::SyntheticRig> practice;  ///< the simulated workstation, without a device
  bool windows = true;                                ///< false: the robot runs without display
  WizardDisplay display;
  bool sounds = true;
  std::function<void(const std::string& line)> report = [](const std::string&) {};
  std::function<bool()> interrupted = [] { return false; };  ///< polled many times a second
};

class GuidedProcedure {
 protected:
  using Clock = std::chrono::steady_clock;

  /// `robot`: a robot holds the stylus. Throws UsageError without device or practice rig, or without a window unless
  /// the robot holds a practice stylus.
  GuidedProcedure(const GuidedRun& run, glm::ivec2 screen_px, bool robot);

  /// Handles window events of a page seen through `rig`.
  void takeEvents(const calibration::Rig& rig);
  std::optional<TrueStylus> trueStylus() { return source_ ? source_->seen() : std::nullopt; }
  /// Mouse and keys hold a practice stylus.
  bool isPractisedByHand() const { return run_.practice && run_.device == nullptr && !robot_; }
  double shownFor_s() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

  std::optional<Sounds> sounds_;
  std::optional<WizardScreen> screen_;
  std::unique_ptr<StylusSource> source_;  ///< none yet for a robot
  std::vector<StylusSample> samples_;
  WizardView view_;
  bool left_ = false;

 private:
  const GuidedRun& run_;
  bool robot_;
  Clock::time_point began_ = Clock::now();
};

}  // namespace app
