// All of a wizard's page that has a place in space: targets, the next one glowing, how to hold the stylus there and how
// it is held, the ring that fills while it is held still, the tip as it is believed, and on a practice device the
// stylus itself, which nobody could see otherwise. Frame W, mm, as one eye sees it. Any one thread; a millisecond.
#pragma once

#include <optional>

#include "app/calibrate/wizard_view.h"
#include "app/report/screen_page.h"

namespace app {

/// A stylus as it truly is.
struct TrueStylus {
  calibration::Point<calibration::World> tip_W;
  calibration::Vector<calibration::World> along_W;  ///< unit, from the tip to the handle
};

/// `glow`: 0 to 1, how bright the next target is now.
void drawScene(const ScreenPage& page, const calibration::Rig& rig, render::Eye eye, const WizardView& view,
               const std::optional<TrueStylus>& stylus, double glow);

}  // namespace app
