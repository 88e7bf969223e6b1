// Shows the start screen in a window of its own until somebody starts or leaves. Main thread.
#pragma once

#include "app/start_screen/start_menu.h"
#include "app/text/message.h"

namespace app {

/// Whether to start; what was chosen is in the menu. False: Esc or the window was closed. Throws GpuError where no
/// window can be opened.
bool showStartScreen(StartMenu& menu, const ReportLine& report);

}  // namespace app
