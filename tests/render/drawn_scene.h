// Helpers for drawn images: rays of pixels, the points they hit, comparisons.
#pragma once

#include <optional>

#include "render/display/camera.h"
#include "render/frame_renderer.h"
#include "tests/render/ball_volume.h"

namespace render::testing {

/// Centre of pixel (x, y), rows top first, as a direction in P of the eye's ray.
inline glm::dvec3 rayDirection_P(const calibration::Rig& rig, const EyeView& view, int x, int y) {
  const double u = (x + 0.5) / rig.screen.px.x, v = 1.0 - (y + 0.5) / rig.screen.px.y;
  const glm::dvec3 on_screen_W = view.lower_left_W.mm + u * view.right_edge_W.xyz + v * view.up_edge_W.xyz;
  return glm::conjugate(rig.X_WP.rotation) * glm::normalize(on_screen_W - view.eye_W.mm);
}

inline glm::dvec3 eye_P_mm(const calibration::Rig& rig, const EyeView& view) {
  return (rig.X_WP.inverse() * view.eye_W).mm;
}

/// Projection of a point of P, px from the top left; pixel centres at +0.5.
inline glm::dvec2 pixelOf(const calibration::Rig& rig, const EyeView& view, const glm::dvec3& p_P_mm) {
  const glm::dvec4 clip = clipFromPatient(rig, view) * glm::dvec4(p_P_mm, 1.0);
  return {(0.5 + 0.5 * clip.x / clip.w) * rig.screen.px.x, (0.5 - 0.5 * clip.y / clip.w) * rig.screen.px.y};
}

/// Distance along a unit ray to a ball, if it is hit.
inline std::optional<double> distanceToBall_mm(const glm::dvec3& from, const glm::dvec3& direction, const Ball& ball) {
  const glm::dvec3 to = ball.centre_P_mm - from;
  const double along = glm::dot(to, direction);
  const double under = ball.radius_mm * ball.radius_mm - (glm::dot(to, to) - along * along);
  if (under <= 0.0) return std::nullopt;
  return along - std::sqrt(under);
}

inline std::size_t pixelsThatDiffer(const Image& a, const Image& b, int tolerance = 0) {
  std::size_t count = 0;
  for (std::size_t p = 0; p + 3 < a.rgba.size(); p += 4) {
    int worst = 0;
    for (std::size_t c = p; c < p + 3; ++c) worst = std::max(worst, std::abs(a.rgba[c] - b.rgba[c]));
    count += worst > tolerance ? 1u : 0u;
  }
  return count;
}

inline Frame frameFor(const calibration::Rig& rig) {
  Frame frame;
  frame.rig = rig;
  frame.tool_visible = false;
  return frame;
}

/// The same virtual screen and eyes with a panel behind a mirror: images on the panel are flipped left to right.
inline calibration::Rig throughMirror(calibration::Rig rig) {
  const calibration::ScreenCorners seen = rig.screen;
  rig.mirror = calibration::Plane<calibration::World>{glm::normalize(glm::dvec3(0.2, 0.8, 0.5)), 30.0};
  const calibration::Point<calibration::World> upper_right{seen.lower_right.mm + seen.upper_left.mm -
                                                           seen.lower_left.mm};
  rig.screen.lower_left = rig.mirror->reflect(seen.lower_right);
  rig.screen.lower_right = rig.mirror->reflect(seen.lower_left);
  rig.screen.upper_left = rig.mirror->reflect(upper_right);
  return rig;
}

}  // namespace render::testing
