// Mouse and keys as the hand on a practice stylus: drag moves its tip in the plane of the screen, the wheel 1 mm a
// notch towards the person or away, arrows tilt it by 3 degrees, the space bar is its button, H puts it into the
// inkwell or takes it out. A target that is near draws the tip into it, as a pit does, with what an eye or a pit leaves
// of error. Frame W, mm. UI thread.
#pragma once

#include <random>

#include "app/calibrate/practice_stylus.h"
#include "app/calibrate/wizard_view.h"
#include "render/display/window.h"

namespace app {

class PracticeInput {
 public:
  PracticeInput(const PracticePose& start, std::uint32_t seed) : hold_(start), rng_(seed) {}

  /// `across_W`, `up_W`: what a pixel of the window to the right and one upwards is on the virtual screen.
  void take(const render::WindowEvent& event, const glm::dvec3& across_W, const glm::dvec3& up_W);
  PracticePose hold(const WizardView& view);

 private:
  void tilt(const glm::dvec3& axis_W, double turn_rad);

  PracticePose hold_;
  glm::dvec3 towards_W_{0.0, 0.0, 1.0}, up_W_{0.0, 1.0, 0.0};
  std::mt19937 rng_;
  // The target that holds the tip, and how far from its middle.
  glm::dvec3 held_W_{0.0}, off_mm_{0.0};
  bool is_held_ = false;
};

}  // namespace app
