// The static part of a wizard's page: text, choices, values, verdict, the letter F and the bar. In the plane of the
// screen, so the same for both eyes. Letters are at least 8 mm high on a 24-inch screen and scale with the screen. The
// middle 110 mm are left to the targets. Any one thread; some milliseconds.
#pragma once

#include <string>

#include "app/calibrate/wizard_view.h"
#include "app/report/screen_page.h"

namespace app {

void drawText(const ScreenPage& page, const WizardView& view);

/// Everything drawText() draws of a view; equal for views that look the same.
std::string textOf(const WizardView& view);

}  // namespace app
