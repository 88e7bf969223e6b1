#include "calibration/webcam/ring_image.h"

#include <algorithm>
#include <cmath>

#include "calibration/rig.h"

namespace calibration {

GreyImage ringImage(const Rig& rig, const Point<World>& eye_W, const Point<World>& tip_W) {
  const ScreenCorners seen = virtualScreen(rig);
  const glm::dvec3 corner = seen.upper_left.mm;
  const glm::dvec3 down = -seen.up_mm(), across = seen.across_mm();
  const glm::ivec2 px = rig.screen.px;
  const glm::dvec3 sight = glm::normalize(tip_W.mm - eye_W.mm);
  // Size of a screen pixel at the tip's distance.
  const double pixel_mm =
      glm::length(across) / px.x * glm::distance(tip_W.mm, eye_W.mm) / glm::distance(seen.centre_mm(), eye_W.mm);

  GreyImage image = GreyImage::filled(px, 0);
  std::size_t at = 0;
  for (int y = 0; y < px.y; ++y)
    for (int x = 0; x < px.x; ++x, ++at) {
      const glm::dvec3 position = corner + (x + 0.5) / px.x * across + (y + 0.5) / px.y * down - eye_W.mm;
      const double ahead = glm::dot(position, sight);
      if (ahead <= 0.0) continue;
      // Distance of this line of sight from the tip, in the plane across it.
      const double off_mm = glm::length(position * (glm::distance(tip_W.mm, eye_W.mm) / ahead) - (tip_W.mm - eye_W.mm));
      const double covered = 0.5 + (0.5 * kRingLine_mm - std::abs(off_mm - kRingRadius_mm)) / pixel_mm;
      // Coverage is light; encode with gamma 2.2.
      image.grey[at] = static_cast<std::uint8_t>(255.0 * std::pow(std::clamp(covered, 0.0, 1.0), 1.0 / 2.2) + 0.5);
    }
  return image;
}

}  // namespace calibration
