// The built-in face on a scanned jaw that brings none: lips, cheek and tongue that are in the surgeon's way, by the
// size of a usual face and not the patient's. Placed by the lower teeth, 1:1, mouth open, cheek retracted on the
// operated side. Frame P. Start-up only; some seconds on two cores.
#pragma once

#include <string>

#include "assets/patient.h"

namespace app {

/// Gives the patient the built-in face. Why not, in a line; empty: it has it.
std::string placeBuiltInFace(assets::Patient& patient);

}  // namespace app
