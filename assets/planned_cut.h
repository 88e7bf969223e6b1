// A cut as it is planned on a patient: a straight trough that a bur of this radius takes, sweeping along a line on the
// bone's surface and sinking square to it. Frame P, mm; directions need not be unit. The line runs along outward x
// aside, half its length to either side of the middle. Plain data; any thread. Not the hand that cuts it.
#pragma once

#include <glm/glm.hpp>

namespace assets {

struct PlannedCut {
  glm::dvec3 middle_P_mm{0.0};  ///< of the line, on the bone's surface
  glm::dvec3 outward_P{0.0};    ///< out of the bone, where the bur comes from
  glm::dvec3 lateral_P{0.0};    ///< across the line, away from the tooth: to the cheek
  double bur_radius_mm = 2.0;
  double length_mm = 8.0;  ///< of the line
  double depth_mm = 4.0;   ///< how far the bur's lowest point goes below the surface
};

}  // namespace assets
