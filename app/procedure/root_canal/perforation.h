// Where the cavity of a tooth is open to what lies around its root: through the wall of the access, a strip of a root,
// or an apex that was widened. What was open before counts for nothing. Air of the tooth is flooded from its pulp; the
// area is that of the hole's opening (its vector area: exact for a flat hole of any direction). Frame P, mm. Pure; any
// thread; some 0.1 s a molar at 0.04 mm.
#pragma once

#include <string_view>
#include <vector>

#include "app/procedure/root_canal/tooth_blocks.h"
#include "assets/tooth_canals.h"

namespace app {

enum class PerforationKind { access, strip, apex };
std::string_view nameOf(PerforationKind kind);

struct Perforation {
  PerforationKind kind = PerforationKind::access;
  double area_mm2 = 0.0;
  glm::dvec3 middle_P_mm{0.0};
};

/// Whether a block has what may be a hole: where none of those that have changed has, there is none.
bool mayBePerforated(const ToothBlocks& before, const FineSolid& after, const assets::ToothFrame& frame,
                     glm::ivec3 block);

/// The largest first.
std::vector<Perforation> perforations(const ToothBlocks& before, const FineSolid& after,
                                      const assets::ToothCanals& tooth);

}  // namespace app
