// A window in a face that has no cheek held away: everything of it that stands between the surgeon's eye and the third
// molar is cut out, so that the operation can be seen. The cut is exact along the window, not along triangles.
// Frame P, mm. Any thread; one pass over the face. Not a retraction: the cheek is not moved, the skin ends at the
// window.
#pragma once

#include "assets/mesh.h"
#include "assets/patient.h"

namespace assets {

struct CheekWindow {
  glm::dvec3 to_eye_P{0.0, -1.0, 0.0};  ///< from the molar, any length but zero
  double radius_mm = 14.0;              ///< at the molar
  double widening = 0.12;               ///< mm of radius a mm towards the eye
};

/// The face without what lies in the window; parts that vanish are left out. As it is where the site is unknown.
MeshModel withCheekWindow(const MeshModel& face_P, const OperatingSite& site, const CheekWindow& window);

}  // namespace assets
