// Mouse and keyboard as input for a practice stylus: drag moves the tip in the plane of the screen, the wheel moves it
// by 1 mm in depth, arrows tilt it by 3 degrees, a drag with the middle button by 0.3 degrees a pixel, space bar and
// right button are its button, H or a middle click puts it into the inkwell or takes it out. A near target attracts the
// tip, with the error of a pit or an eye. Frame W, mm. UI thread.
#pragma once

#include <random>

#include "app/calibrate/practice_stylus.h"
#include "app/calibrate/wizard_view.h"
#include "render/display/window.h"

namespace app {

/// The line on every page of a practice.
inline constexpr const char* kPracticeKeys =
    "drag moves · wheel in/out · arrows or middle drag tilt · Space or right button = button · H or middle click = "
    "inkwell · Esc = leave";

class PracticeInput {
 public:
  PracticeInput(const PracticePose& start, std::uint32_t seed) : pose_(start), rng_(seed) {}

  /// `across_W`, `up_W`: a window pixel to the right and upwards, on the virtual screen.
  void take(const render::WindowEvent& event, const glm::dvec3& across_W, const glm::dvec3& up_W);
  PracticePose pose(const WizardView& view);

 private:
  void tilt(const glm::dvec3& axis_W, double angle_rad);
  void press(bool down);

  PracticePose pose_;
  glm::dvec3 towards_W_{0.0, 0.0, 1.0}, up_W_{0.0, 1.0, 0.0};
  std::mt19937 rng_;
  // The target that attracts the tip, and the error there.
  glm::dvec3 held_W_{0.0}, off_mm_{0.0};
  bool is_held_ = false;
  int poses_pressed_ = 0;      ///< given since the button went down
  bool release_due_ = false;   ///< it was released before it was seen
  bool middle_moved_ = false;  ///< since the middle button went down: a drag, no click
};

}  // namespace app
