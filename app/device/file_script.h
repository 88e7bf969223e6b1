// What a scripted hand does in a root-canal treatment: the access cavity with a bur where the crown is whole, then size
// after size into every canal that has a foramen of its own, to its working length with small turns to and fro, filed
// there with strokes, and out again; then the straightest of them is filled: a cone that fits it,
// pressed on with a hot plugger. Frame P; mm, s. Start-up only. The hand plans from the canals as they are known,
// and feels nothing: a demonstration and a test, no master.
#pragma once

#include "app/device/pose_source.h"
#include "assets/tooth_canals.h"

namespace app {

/// `opens`: the access too, else it is open. `length_mm`: of the files.
HandScript fileScript(const assets::ToothCanals& tooth, bool opens = false, double length_mm = 25.0);

}  // namespace app
