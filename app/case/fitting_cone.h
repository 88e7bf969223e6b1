// The cone of gutta-percha that a canal takes as it is known: the thickest that reaches the working length, with the
// largest taper that is nowhere thicker than the canal. For the tray and the scripted hand; what was filed is not known
// here. mm. Pure; any thread; some µs.
#pragma once

#include <string>

#include "assets/instrument/gutta_percha_cone.h"
#include "assets/tooth_canals.h"

namespace app {

/// The thinnest that is made where none fits.
assets::GuttaPerchaCone fittingCone(const assets::ToothCanal& canal);
/// As --tool takes it: "gp-cone:30,4".
std::string orderOf(const assets::GuttaPerchaCone& cone);

}  // namespace app
