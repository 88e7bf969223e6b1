// Draws a WizardView for a display: text in the screen's plane, targets in stereo at their positions, upright and
// readable for every panel and mirror. Frame W, mm. Any one thread. 1080p for both eyes side by side takes 10 to 20 ms
// of one core: unchanged text is drawn once. Window and loop: run_wizard.h.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "app/calibrate/page_scene.h"
#include "app/calibrate/wizard_view.h"
#include "app/report/screen_page.h"
#include "calibration/webcam/camera.h"
#include "render/display/stereo_layout.h"
#include "render/image.h"

namespace app {

/// Between two pictures where nobody hurries; the ticks in between are not lost.
inline constexpr std::chrono::milliseconds kPageTime{25};

class WizardPages {
 public:
  /// Through the mirror of this rig; screen and eyes are the view's.
  explicit WizardPages(std::optional<calibration::Plane<calibration::World>> mirror) : mirror_(mirror) {}

  /// What an output of the layout shows. `t_s`: time, for what glows.
  render::Image output(const WizardView& view, const std::optional<TrueStylus>& stylus,
                       const render::StereoLayout& layout, double t_s);
  /// What an eye is shown, `px` pixels over the whole screen.
  render::Image page(const WizardView& view, const std::optional<TrueStylus>& stylus, render::Eye eye, glm::ivec2 px,
                     double t_s);

  /// The rig that a view is drawn through.
  calibration::Rig rigOf(const WizardView& view) const;

 private:
  void prepare(const WizardView& view, glm::ivec2 px);

  std::optional<calibration::Plane<calibration::World>> mirror_;
  // Sheets of one size and screen; the words as they were drawn last.
  glm::ivec2 px_{0};
  calibration::Rig rig_;
  std::unique_ptr<ScreenPage> words_, eye_;
  std::string drawn_words_;
};

/// A camera's pattern over the whole screen, the same for both eyes, pixel by pixel, nothing smoothed. It must be as
/// large as the layout's screen.
render::Image patternForCamera(const calibration::GreyImage& pattern, const render::StereoLayout& layout);

}  // namespace app
