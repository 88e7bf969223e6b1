// What a scripted hand does to prepare a tooth to its ideal, with an upright bur that goes nowhere deeper than the
// ideal lets the whole of its end. A cavity: layer by layer with a narrow cylinder. A crown: roughed out by a cylinder,
// its biting surface and margin finished by a round end, then its walls by the side of that bur, leaning as they do.
// The hand plans from the ideal and feels nothing: a demonstration and a test of the measures, no master. Frame P; mm,
// s. Start-up only, some 0.3 s.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/device/pose_source.h"
#include "app/procedure/preparation/preparation_outcomes.h"
#include "haptics/tool/tool.h"

namespace app {

/// The burs that preparationScript() wants for a rule, as on the command line; nullptr: for an ideal from a file,
/// whatever it is.
std::vector<std::string> scriptedBurs(const IdealRule* rule);

/// `tray`: scriptedBurs().
HandScript preparationScript(const PreparationMeasure& measure, std::span<const haptics::Tool> tray);

}  // namespace app
