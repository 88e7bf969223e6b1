// What has to be true of touches before anything is fitted to them, and how well they are spread: what their stylus
// was turned through and which volume their targets span. Frame W, mm. Pure; any thread but the servo's; below 1 ms for
// a hundred touches.
#pragma once

#include <span>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/touches.h"

namespace calibration {

/// Whether all its numbers are.
bool isFinite(const Touch& touch);

/// Of the touches marked used. Throws CalibrationError, one line that names the touch: an unknown model, numbers that
/// are not finite, the same touch twice, fewer than four, targets all on a line or in one place.
void checkTouches(const TouchSet& set);

/// Touches prove a fit only if they are of the same device and it has not seen them. Throws CalibrationError, one line
/// that names what differs (what is not known of one is not compared) or the touch.
void checkUnseen(const TouchSet& fitted, const TouchSet& verification);

/// How differently the stylus was held, as an angle that 95 of 100 pairs of its directions are within: the smaller of
/// that in the room, which tells of the tip, and that against the forearm, which tells of the gimbal.
double tiltSpread_deg(const PhantomGeometry& geometry, const std::vector<Touch>& touches,
                      std::span<const std::size_t> which);

/// Of unit vectors: the angle that 95 of 100 pairs are within.
double pairSpread_deg(const std::vector<glm::dvec3>& directions);

/// Of the convex hull; 0 of what lies in a plane.
double hullVolume_mm3(const std::vector<glm::dvec3>& positions_mm);

/// Places with no more than this as their least spread lie in a plane.
inline constexpr double kFlatTargets_mm = 3.0;

/// Middle, axes as columns by falling spread, and root mean square distance from the middle along each.
struct Extent {
  glm::dvec3 middle_mm{0.0};
  glm::dmat3 axes{1.0};
  glm::dvec3 spread_mm{0.0};
};
Extent extentOf(const std::vector<glm::dvec3>& positions_mm);

}  // namespace calibration
