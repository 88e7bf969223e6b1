// Where the tip of a file is: in which canal and how far along it. Frame P, mm. Pure; any thread; some µs.
#pragma once

#include <optional>

#include "assets/tooth_canals.h"

namespace app {

struct CanalTip {
  std::size_t canal;
  double along_mm;  ///< from the orifice; beyond the canal's length outside the foramen
  double aside_mm;  ///< from the centre line
};

/// None: in no canal, half a millimetre of wall included.
std::optional<CanalTip> canalTip(const assets::ToothCanals& tooth, const glm::dvec3& tip_P_mm);

}  // namespace app
