// What a tooth bites on: the lowest surface of the opposing teeth where they end up when the jaws are closed on intact
// teeth, of a mesh or a scan (given_antagonist.h), and how the jaws close. Where a case has one jaw alone it is made of
// the intact tooth's own biting surface: smoothed, and lowered onto it until it rests on three places around the
// middle, as a tripod. Made once, some 0.1 s. Frame of the tooth, mm. Plain values; any thread.
#pragma once

#include "app/procedure/preparation/occlusal_heights.h"
#include "assets/prepared_tooth.h"

namespace app {

struct Antagonist {
  OcclusalRaster height_mm;  ///< closed; none: nothing opposes there
  bool is_made = true;       ///< not of a scan: told wherever it is shown
  assets::Closing closing = assets::Closing::axis;
  glm::dvec3 hinge_mm{0.0}, opens{1.0, 0.0, 0.0};  ///< of the hinge: a place of its axis, the turn that opens the jaws
  glm::dvec2 middle_mm{0.0};                       ///< of the tooth's biting surface: balanced are loads there
};

/// For people, wherever a made one is shown.
inline constexpr char kMadeAntagonist[] = "opposing tooth made, not scanned";

/// `intact`: of the tooth before anything was cut.
Antagonist madeAntagonist(const OcclusalRaster& intact);
/// What the tooth has, else a made one; closing as the tooth's bite says.
Antagonist antagonistOf(const Crown& crown, const OcclusalRaster& intact, const assets::PreparedTooth& tooth);

}  // namespace app
