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

EyeView reflected(const EyeView& view, const calibration::Plane<calibration::World>& glass_W, double begins_mm) {
  const glm::dvec3& n = glass_W.normal;
  glm::dmat4 reflection(glm::dmat3(1.0) - 2.0 * glm::outerProduct(n, n));
  reflection[3] = glm::dvec4(2.0 * glass_W.offset_mm * n, 1.0);
  const auto turned = [&n](const calibration::Vector<calibration::World>& v) {
    return calibration::Vector<calibration::World>{v.xyz - 2.0 * glm::dot(n, v.xyz) * n};
  };

  // Clip z from -w at the glass; the far plane lies behind all that is nearer to the axis than 75 degrees.
  constexpr double kLeastCosine = 0.25;
  glm::dmat4 clip = glm::transpose(view.clip_from_W * reflection);
  clip[2] = 2.0 * kLeastCosine * glm::dvec4(n, -glass_W.offset_mm - begins_mm) - clip[3];
  return {.clip_from_W = glm::transpose(clip),
          .eye_W = glass_W.reflect(view.eye_W),
          .lower_left_W = glass_W.reflect(view.lower_left_W),
          .right_edge_W = turned(view.right_edge_W),
          .up_edge_W = turned(view.up_edge_W),
          .mirrored = !view.mirrored};
}

}  // namespace render
