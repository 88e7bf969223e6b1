// Both eyes in one image for red-cyan glasses, the red filter on the left eye. Linear light in 0..1 in and out; twin of
// shaders/stereo_layout.glsl. Any thread; pure. Source of the coefficients: shaders/anaglyph_constants.glsl.
#pragma once

#include <glm/glm.hpp>

#include "render/display/display_mode.h"
#include "render/shaders/anaglyph_constants.glsl"

namespace render {

inline glm::dvec3 anaglyph(DisplayMode mode, const glm::dvec3& left, const glm::dvec3& right) {
  if (mode == DisplayMode::anaglyph_red_cyan) return {left.r, right.g, right.b};
  const glm::dvec3 mixed{
      glm::dot(glm::dvec3(DUBOIS_LEFT_RED), left) + glm::dot(glm::dvec3(DUBOIS_RIGHT_RED), right),
      glm::dot(glm::dvec3(DUBOIS_LEFT_GREEN), left) + glm::dot(glm::dvec3(DUBOIS_RIGHT_GREEN), right),
      glm::dot(glm::dvec3(DUBOIS_LEFT_BLUE), left) + glm::dot(glm::dvec3(DUBOIS_RIGHT_BLUE), right)};
  return glm::clamp(mixed, 0.0, 1.0);
}

}  // namespace render
