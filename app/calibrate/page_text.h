// All of a wizard's page that does not move: words, choices, numbers, verdict, the F and the bar. In the plane of the
// screen, so both eyes get the same. Letters are at least 8 mm high on a 24-inch screen and grow and shrink with it.
// The middle, 110 mm high, is left to the targets where there are any. Any one thread; some milliseconds.
#pragma once

#include <string>

#include "app/calibrate/wizard_view.h"
#include "app/report/screen_page.h"

namespace app {

/// How much larger than a 24-inch screen's a page is drawn.
double scaleOf(const ScreenPage& page);

void drawText(const ScreenPage& page, const WizardView& view);

/// The same for two views: their words look the same.
std::string textOf(const WizardView& view);

}  // namespace app
