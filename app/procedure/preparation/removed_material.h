// P1 and P7 of a preparation: what was left too much and cut too much against the ideal, by zone, what was cut in all,
// and what was cut of a neighbour; pulp that lies open, and dentine that is left over it (reference/sisters 5.3). mm,
// mm³. Pure; any thread; some 50 ms.
#pragma once

#include <array>
#include <functional>

#include "app/procedure/preparation/prepared_ideal.h"

namespace app {

struct ZoneBalance {
  double over_mm3 = 0.0;   ///< cut, and should have stayed
  double under_mm3 = 0.0;  ///< left, and should have been cut
};

struct RemovedMaterial {
  std::array<ZoneBalance, kPreparedZones> zones;
  double wanted_mm3 = 0.0;  ///< that the ideal takes
  double enamel_mm3 = 0.0, dentine_mm3 = 0.0;
  double neighbour_mm3 = 0.0;
  double pulp_open_mm2 = 0.0;  ///< of the pulp's surface, to the cut

  double over_mm3() const;
  double under_mm3() const;
};

/// Of a place in the tooth's frame.
using ZoneOf = std::function<PreparedZone(const glm::dvec3& p_mm)>;

RemovedMaterial removedMaterial(const Crown& crown, const BoxBytes& made, const BoxBytes& ideal, const ZoneOf& zone_of);

}  // namespace app
