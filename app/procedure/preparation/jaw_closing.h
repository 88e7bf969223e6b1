// How far the jaws close on a tooth (reference/sisters 5.4): straight along its axis, about the hinge of the condyles,
// or until what opposes it, having met it, has tipped onto three contacts around its middle. Never farther than where
// the rest of the teeth meet. The opposing teeth move as one body: their surface is turned and shifted, not each of its
// heights. Frame of the tooth, mm. Pure; any thread; 10 ms along the axis, some 0.1 s else.
#pragma once

#include <optional>

#include "app/procedure/preparation/antagonist.h"
#include "app/procedure/preparation/narrowest_gap.h"

namespace app {

/// p becomes turn p + shift.
struct JawMotion {
  glm::dmat3 turn{1.0};
  glm::dvec3 shift_mm{0.0};

  glm::dvec3 at(const glm::dvec3& p_mm) const { return turn * p_mm + shift_mm; }
};

/// A surface that was moved, over the places where `heights` has some.
OcclusalRaster movedOver(const OcclusalRaster& heights, const OcclusalRaster& surface, const JawMotion& motion);

struct ClosedJaws {
  JawMotion motion;       ///< of the opposing teeth, from where the rest of the teeth meet
  OcclusalRaster gap_mm;  ///< along the tooth's axis
  NarrowestGap narrowest;
  glm::dvec2 first_mm{0.0};  ///< where it touches first, if it does
  double open_mm = 0.0;      ///< that the tooth keeps them apart, where it touches first
  bool is_balanced = false;  ///< on three contacts
};

ClosedJaws closedOn(const OcclusalRaster& heights, const Antagonist& antagonist);

}  // namespace app
