// The quality a rehearsal is drawn with: by measured frame times on the quality ladder in a window, fixed if a step was
// chosen, and as the frame requests without a window. Never changes during a stroke. Main thread.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "app/view/surgeon_display.h"
#include "render/quality_ladder.h"

namespace app {

class QualityChoice {
 public:
  /// `held`: fixed step, 0 best. Borrows the display.
  QualityChoice(SurgeonDisplay& display, std::optional<int> held)
      : display_(display),
        held_(held.has_value()),
        budget_s_(display.backend() == render::Backend::cpu ? std::max(1.0 / display.refresh_Hz(), kSlowestSmooth_s)
                                                            : 1.0 / display.refresh_Hz()),
        ladder_(budget_s_, held.value_or(firstStep(display))) {}

  /// Whether the ladder overrides the frame's own quality.
  bool overridesFrame() { return isChoosing() || held_; }
  /// The ladder draws less than it could.
  bool isReduced() { return isChoosing() && ladder_.step() > 0; }
  render::Quality quality() const { return ladder_.quality(); }

  /// Draws until the step for this machine is found, at most three seconds. `draw` draws a frame at the current
  /// quality.
  template <class Draw>
  void settle(Draw draw) {
    const auto begun = SurgeonDisplay::Clock::now();
    for (int unchanged = 0;
         isChoosing() && unchanged < kSettled && SurgeonDisplay::Clock::now() - begun < kMaxSettling;) {
      draw();
      unchanged = ladder_.add(display_.drawing_s(), true) ? 0 : unchanged + 1;
    }
  }
  /// Adds the newest frame's time. True if the quality changed.
  bool update(bool in_stroke) { return isChoosing() && ladder_.add(display_.drawing_s(), !in_stroke); }

  /// Time for drawing a frame: one refresh of the display, without a graphics card at least 1/30 s.
  double budget_s() const { return budget_s_; }
  int step() const { return ladder_.step(); }
  bool isHeld() const { return held_; }
  std::string text() { return overridesFrame() ? std::string(ladder_.description()) : "as requested"; }

 private:
  static constexpr double kSlowestSmooth_s = 1.0 / 30.0;
  static constexpr int kSettled = 4;  ///< frames without a change
  static constexpr std::chrono::seconds kMaxSettling{3};

  /// Without a graphics card the first picture is one as it is drawn while something moves: in tenths of a second
  /// instead of seconds. It refines when nothing moves.
  static int firstStep(SurgeonDisplay& display) {
    return display.window() != nullptr && display.drawsOnProcessor()
               ? static_cast<int>(render::kQualitySteps.size()) - 1
               : 0;
  }
  bool isChoosing() { return display_.window() != nullptr && !held_; }

  SurgeonDisplay& display_;
  bool held_;
  double budget_s_;
  render::QualityLadder ladder_;
};

}  // namespace app
