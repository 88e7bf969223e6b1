// The face around a scanned jaw. The built-in one: lips, cheek and tongue that are in the surgeon's way, by the size of
// a usual face and not the patient's; placed by the lower teeth, 1:1, mouth open, cheek retracted on the operated side.
// Or the patient's own, where the scan shows it. Frame P. Start-up only; some seconds on two cores.
#pragma once

#include <string>

#include "assets/patient.h"

namespace app {

/// Gives the patient the built-in face, and the pose of its head. Why not, in a line; empty: it has it.
std::string placeBuiltInFace(assets::Patient& patient);

/// Gives the patient its own face, and the pose of the head that the teeth tell, where they do. False: the scan shows
/// too little skin.
bool placeOwnFace(assets::Patient& patient);

}  // namespace app
