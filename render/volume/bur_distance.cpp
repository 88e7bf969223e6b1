#include "render/volume/bur_distance.h"

#include <algorithm>
#include <cmath>

#include "render/volume/guide_field.h"

namespace render {

double burDistance_mm(const Frame& frame, const glm::dvec2& p) {
  const double radius = frame.bur_radius_mm, half = 0.5 * frame.bur_length_mm;
  switch (frame.bur_form) {
    case assets::BurForm::round:
      return glm::length(p) - radius;
    case assets::BurForm::capsule:
      return glm::length(glm::dvec2(p.x, p.y - std::clamp(p.y, -half, half))) - radius;
    case assets::BurForm::cylinder: {
      const glm::dvec2 out{p.x - radius, std::abs(p.y) - half};
      return std::min(std::max(out.x, out.y), 0.0) + glm::length(glm::max(out, 0.0));
    }
    case assets::BurForm::cone: {
      const glm::dvec2 rim{radius, half};
      const double nearest = std::min(calibration::distanceToSegment(p, {0.0, -half}, rim),
                                      calibration::distanceToSegment(p, {0.0, half}, rim));
      const bool inside = p.y < half && p.x * 2.0 * half < radius * (p.y + half);
      return inside ? -nearest : nearest;
    }
    case assets::BurForm::revolved:
      return assets::outlineDistance_mm(assets::burOutline(frame.bur_profile, radius, 2.0 * half), std::abs(p.x), p.y);
  }
  return 0.0;
}

double burReach_mm(const Frame& frame) {
  const double radius = frame.bur_radius_mm, half = 0.5 * frame.bur_length_mm;
  switch (frame.bur_form) {
    case assets::BurForm::round:
      return radius;
    case assets::BurForm::capsule:
      return radius + half;
    case assets::BurForm::cylinder:
    case assets::BurForm::cone:
    case assets::BurForm::revolved:
      break;
  }
  return std::hypot(radius, half);
}

}  // namespace render
