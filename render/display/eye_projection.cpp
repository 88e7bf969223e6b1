#include "render/display/eye_projection.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "calibration/rig.h"

namespace render {

EyeView eyeView(const calibration::Rig& rig, Eye eye) {
  const calibration::Point<calibration::World> eye_W = eye == Eye::left    ? rig.left_eye
                                                       : eye == Eye::right ? rig.right_eye
                                                                           : rig.cyclopeanEye();
  const glm::dvec3 e = eye_W.mm;
  const calibration::ScreenCorners seen = calibration::virtualScreen(rig);
  const glm::dvec3 pll = seen.lower_left.mm, plr = seen.lower_right.mm, pul = seen.upper_left.mm;

  // Basis of the virtual screen, its normal towards the eye.
  const glm::dvec3 vr = glm::normalize(plr - pll), vu = glm::normalize(pul - pll);
  glm::dvec3 vn = glm::normalize(glm::cross(vr, vu));
  const bool mirrored = glm::dot(vn, e - pll) < 0.0;
  if (mirrored) vn = -vn;

  // The frustum through the screen's edges, at the near plane; with reverse-Z floats a wide range costs no precision.
  const double distance_mm = glm::dot(vn, e - pll);
  const double near_mm = kNearOfScreen * std::max(distance_mm, 1.0), far_mm = kFarOfScreen * std::max(distance_mm, 1.0);
  const double k = near_mm / std::max(distance_mm, 1e-6);
  const glm::dmat4 frustum = glm::frustumRH_NO(glm::dot(vr, pll - e) * k, glm::dot(vr, plr - e) * k,
                                               glm::dot(vu, pll - e) * k, glm::dot(vu, pul - e) * k, near_mm, far_mm);
  const glm::dmat4 rotation = glm::transpose(
      glm::dmat4(glm::dvec4(vr, 0.0), glm::dvec4(vu, 0.0), glm::dvec4(vn, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0)));
  return {.clip_from_W = frustum * rotation * glm::translate(glm::dmat4(1.0), -e),
          .eye_W = eye_W,
          .lower_left_W = {pll},
          .right_edge_W = {plr - pll},
          .up_edge_W = {pul - pll},
          .mirrored = mirrored};
}

}  // namespace render
