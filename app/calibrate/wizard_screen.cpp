#include "app/calibrate/wizard_screen.h"

namespace app {

WizardScreen::WizardScreen(const WizardDisplay& display, glm::ivec2 screen_px, const ReportLine& report)
    : windows_({.mode = display.mode,
                .screen_px = screen_px,
                .full_screen = display.full_screen,
                .monitor = display.monitor},
               report),
      screen_(windows_, screen_px, display.swapped) {}

}  // namespace app
