// Checks of touches before a fit, and their spread in stylus tilt and volume. Frame W, mm. Pure; any thread but the
// servo's; below 1 ms for a hundred touches.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_fit.h"
#include "calibration/fit/touches.h"

namespace calibration {

bool isFinite(const Touch& touch);

/// Of the touches marked used. Throws CalibrationError naming the touch: unknown model, numbers not finite, the same
/// touch twice, fewer than four, targets on a line or at one position.
void checkTouches(const TouchSet& set);

/// Verification touches must be of the same device and not in the fit. Throws CalibrationError naming what differs
/// (empty fields are not compared) or the touch.
void checkUnseen(const TouchSet& fitted, const TouchSet& verification);
/// The same for a rig file, which keeps residuals and no touches: a touch of the fit has the same error at the same
/// target. `file`: of the verification, for the message.
void checkUnseen(const std::vector<Residual>& fitted, const std::vector<Residual>& verification,
                 const std::string& file);

/// Variety of the stylus directions: the 95th percentile of the angles between pairs, in W (for the tip) or
/// relative to the forearm (for the gimbal), whichever is smaller.
double tiltSpread_deg(const PhantomGeometry& geometry, const std::vector<Touch>& touches,
                      std::span<const std::size_t> which);

/// 95th percentile of the angles between pairs of unit vectors.
double pairSpread_deg(const std::vector<glm::dvec3>& directions);

/// Volume of the convex hull; 0 for points in a plane.
double hullVolume_mm3(const std::vector<glm::dvec3>& positions_mm);

/// Points with a smaller least spread count as planar.
inline constexpr double kFlatTargets_mm = 3.0;

/// Centre, principal axes as columns by decreasing spread, and RMS distance from the centre along each.
struct Extent {
  glm::dvec3 middle_mm{0.0};
  glm::dmat3 axes{1.0};
  glm::dvec3 spread_mm{0.0};
};
Extent extentOf(const std::vector<glm::dvec3>& positions_mm);

}  // namespace calibration
