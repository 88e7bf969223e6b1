// The part of a wizard's page with a position in space: targets (the next one glows), wanted and present tilt, the ring
// that fills while the stylus is held still, the tip, and the stylus itself on a practice device. Frame W, mm, for one
// eye. Any one thread; a millisecond.
#pragma once

#include <optional>

#include "app/calibrate/wizard_view.h"
#include "app/report/screen_page.h"

namespace app {

/// The true pose of a simulated stylus.
struct TrueStylus {
  calibration::Point<calibration::World> tip_W;
  calibration::Vector<calibration::World> along_W;  ///< unit, from the tip to the handle
};

/// `glow`: brightness of the next target, 0 to 1.
void drawScene(const ScreenPage& page, const calibration::Rig& rig, render::Eye eye, const WizardView& view,
               const std::optional<TrueStylus>& stylus, double glow);

}  // namespace app
