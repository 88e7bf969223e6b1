// Shows the check page of a patient folder in a window of its own until it is left. Main thread.
#pragma once

#include <string>

#include "app/text/message.h"

namespace app {

/// Throws LoadError for the folder, GpuError where no window can be opened.
void showCheckPage(const std::string& folder, const ReportLine& report);

}  // namespace app
