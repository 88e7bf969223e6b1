// Shows the check page of a patient folder in a window until it is left. Main thread; the patient is read on another,
// while the window says so.
#pragma once

#include <string>

#include "app/check_page/check_window.h"
#include "app/text/message.h"

namespace app {

/// In a window of its own. Throws LoadError for the folder, GpuError where no window can be opened.
void showCheckPage(const std::string& folder, const ReportLine& report);

/// In one that is open. Throws LoadError.
void showCheckPage(CheckWindow& window, const std::string& folder, const ReportLine& report);

}  // namespace app
