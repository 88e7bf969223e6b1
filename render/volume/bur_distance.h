// Signed distance to the cutting head of a frame's bur, negative inside; outlines as assets::BurForm. Frame T, mm.
// Closed forms in the half-plane of radius and axis. Any thread; pure; about 10 ns.
#pragma once

#include <glm/glm.hpp>

#include "render/frame.h"

namespace render {

/// Of a point at that distance from the axis, and along it.
double burDistance_mm(const Frame& frame, const glm::dvec2& radius_and_z_mm);
inline double burDistance_mm(const Frame& frame, const glm::dvec3& p_T_mm) {
  return burDistance_mm(frame, glm::dvec2(glm::length(glm::dvec2(p_T_mm)), p_T_mm.z));
}
/// Radius of the ball about T's origin that holds the head.
double burReach_mm(const Frame& frame);

}  // namespace render
