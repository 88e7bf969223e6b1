// The front of a lower row of teeth, as a dentoform has it: from one first premolar over the midline to the other, in a
// ridge of bone with gum around the necks. The built-in patient has none of these teeth; a single incisor or canine is
// set in here. Teeth by the same parameters as the others' (tooth_parameters.h), on the same arch. Frame P of a left
// jaw, mm. Any thread; some 2 s at 0.25 mm.
#pragma once

#include "assets/ct_volume.h"
#include "assets/tooth_canals.h"

namespace assets {

inline constexpr double kFrontRowVoxel_mm = 0.25;

/// Solid, labels (teeth: enamel and dentine) and numbers, 34 to 44; no grey values.
CtVolume frontRow(double spacing_mm = kFrontRowVoxel_mm);

/// Of a tooth of it: 31 to 34, 41 to 44.
ToothFrame frontToothFrame(int fdi);

}  // namespace assets
