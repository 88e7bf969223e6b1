// Which quality a rehearsal is drawn with: by measured frame times on the quality ladder where there is a window, held
// where somebody chose a step, and as asked where nobody watches. Never changes during a stroke. Main thread.
#pragma once

#include <optional>
#include <string>

#include "app/view/surgeon_display.h"
#include "render/quality_ladder.h"

namespace app {

class QualityChoice {
 public:
  /// `held`: the step, 0 best. Borrows the display.
  QualityChoice(SurgeonDisplay& display, std::optional<int> held);

  /// True where the ladder rules over what a frame asked for.
  bool rules() { return isChoosing() || held_; }
  render::Quality quality() const { return ladder_.quality(); }

  /// Draws until this machine's step is found, at most three seconds. `draw` draws a frame of the quality in force.
  template <class Draw>
  void settle(Draw draw) {
    const auto begun = SurgeonDisplay::Clock::now();
    for (int unchanged = 0; isChoosing() && unchanged < kSettled && SurgeonDisplay::Clock::now() - begun < kLongest;) {
      draw();
      unchanged = ladder_.add(display_.drawing_s(), true) ? 0 : unchanged + 1;
    }
  }
  /// Takes in the newest frame's time. True: the quality is another from now on.
  bool follow(bool stroke) { return isChoosing() && ladder_.add(display_.drawing_s(), !stroke); }

  /// For drawing a frame: with a graphics card every refresh of the display; without one, what still looks like motion.
  double budget_s() const { return budget_s_; }
  int step() const { return ladder_.step(); }
  bool isHeld() const { return held_; }
  std::string text() { return rules() ? std::string(ladder_.description()) : "as asked"; }

 private:
  static constexpr int kSettled = 4;  ///< pictures without a change of quality
  static constexpr std::chrono::seconds kLongest{3};

  bool isChoosing() { return display_.window() != nullptr && !held_; }

  SurgeonDisplay& display_;
  bool held_;
  double budget_s_;
  render::QualityLadder ladder_;
};

}  // namespace app
