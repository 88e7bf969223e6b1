// What covers tooth and bone at the operated site in a frame: a film of water, blood, dust of dry cutting, the spray of
// the irrigation. Shares 0..1, as drawn; app advances them with the servo's ticks (app/session/field_clarity.h). All 0,
// as for a dry specimen, leaves every pixel as it is. Frame P, mm. Plain data; any thread.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace render {

struct SurgicalField {
  calibration::Point<calibration::Patient> centre_P;  ///< where bone was removed last
  double reach_mm = 0.0;                              ///< cover falls to 1/e at this distance; 0: the same everywhere
  double water = 0.0;                                 ///< thickness of the film: 0.35 moist as living bone, 1 flooded
  double blood = 0.0;                                 ///< of cut marrow and of hollows that hold fluid
  double dust = 0.0;                                  ///< chips that lie on the surface
  double spray = 0.0;                                 ///< mist of the irrigation
};

}  // namespace render
