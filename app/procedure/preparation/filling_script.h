// What a scripted hand does to fill a cavity that is cut: composite in increments of at most 1.2 mm, each cured for 15
// s before the next; the last one, before its light, carved along the intact surface. The hand plans from the intact
// tooth and its ideal and feels nothing. Frame P; mm, s. Start-up only, some 0.3 s.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/device/pose_source.h"
#include "app/procedure/preparation/preparation_outcomes.h"
#include "haptics/tool/tool.h"

namespace app {

/// What fillingScript() wants, as on the command line: a bur, with which every rehearsal begins, is the first.
std::vector<std::string> fillingTray();

/// `measure`: of the tooth before its cavity was cut. `tray`: fillingTray().
HandScript fillingScript(const PreparationMeasure& measure, std::span<const haptics::Tool> tray);

}  // namespace app
