// A planned straight trough: a bur of the given radius sweeps along a line on the bone's surface and sinks along its
// normal. The line is centred at middle_P_mm and runs along outward x lateral. Frame P, mm; directions need not be
// unit. Plain data.
#pragma once

#include <glm/glm.hpp>

namespace assets {

struct PlannedCut {
  glm::dvec3 middle_P_mm{0.0};  ///< of the line, on the bone's surface
  glm::dvec3 outward_P{0.0};    ///< out of the bone, towards the bur
  glm::dvec3 lateral_P{0.0};    ///< across the line, away from the tooth (buccal)
  double bur_radius_mm = 2.0;
  double length_mm = 8.0;  ///< of the line
  double depth_mm = 4.0;   ///< of the bur's lowest point below the surface
};

}  // namespace assets
