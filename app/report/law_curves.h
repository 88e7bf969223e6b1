// Force and stiffness over depth of a bur pressed into flat cortical bone, computed by the servo's own laws on a fine
// phantom. mm, N. Start-up only: a second for all laws.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "haptics/contact/law_settings.h"
#include "haptics/tool/bur_shape.h"

namespace app {

struct LawCurve {
  haptics::LawKind law = haptics::LawKind::agus;
  std::vector<glm::dvec2> force_N;             ///< depth, force outward
  std::vector<glm::dvec2> stiffness_N_per_mm;  ///< depth, dF/dh
};

struct BurIndentation {
  haptics::BurShape head;
  double deepest_mm = 1.0;
  double spindle_rpm = 40000.0, feed_mm_per_s = 1.0;  ///< of the machining law
};

LawCurve lawCurve(const haptics::LawSettings& law, const BurIndentation& bur);

}  // namespace app
