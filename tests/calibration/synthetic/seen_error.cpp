#include "tests/calibration/synthetic/seen_error.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/rotation.h"
#include "calibration/random.h"
#include "calibration/rig.h"

namespace calibration {
namespace {

/// Where the line of sight to a point meets the screen, in I.
Point<ScreenImage> drawnOnScreen(const Viewing& viewing, const Point<World>& eye_W, const Point<World>& position_W) {
  const auto X_IW = viewing.X_WI.inverse();
  const glm::dvec3 eye = (X_IW * eye_W).mm, position = (X_IW * position_W).mm;
  return {eye + eye.z / (eye.z - position.z) * (position - eye)};
}

}  // namespace

Viewing believedViewing(const Rig& rig) {
  const ScreenCorners seen = virtualScreen(rig);
  const glm::dvec3 origin = seen.lower_left.mm;
  const glm::dvec3 x = glm::normalize(seen.lower_right.mm - origin), y = glm::normalize(seen.upper_left.mm - origin);
  return {rig.left_eye, rig.right_eye, {glm::normalize(glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y)))), origin}};
}

Point<World> seenPlace(const Viewing& drawn_for, const Viewing& seen_by, const Point<World>& drawn_W) {
  const Point<World> left_W = seen_by.X_WI * drawnOnScreen(drawn_for, drawn_for.left_eye, drawn_W);
  const Point<World> right_W = seen_by.X_WI * drawnOnScreen(drawn_for, drawn_for.right_eye, drawn_W);
  const glm::dvec3 a = glm::normalize((left_W - seen_by.left_eye).xyz);
  const glm::dvec3 b = glm::normalize((right_W - seen_by.right_eye).xyz);

  // The nearest points of two lines.
  const glm::dvec3 apart = (seen_by.left_eye - seen_by.right_eye).xyz;
  const double ab = glm::dot(a, b), along_a = glm::dot(a, apart), along_b = glm::dot(b, apart), sine2 = 1.0 - ab * ab;
  const double s = (ab * along_b - along_a) / sine2, t = (along_b - ab * along_a) / sine2;
  return {0.5 * (seen_by.left_eye.mm + s * a + seen_by.right_eye.mm + t * b)};
}

Viewing actualViewing(const Viewing& believed, const ViewingCare& care, std::mt19937& rng) {
  Viewing actual = believed;
  const glm::dvec3 head_mm = gaussianVector(rng, care.head_sd_mm);
  const glm::dvec3 across = glm::normalize((believed.right_eye - believed.left_eye).xyz);
  const glm::dvec3 wider_mm = 0.5 * uniform(rng, -care.pupils_mm, care.pupils_mm) * across;
  actual.left_eye.mm += head_mm - wider_mm;
  actual.right_eye.mm += head_mm + wider_mm;

  // The screen rotates about the origin of W, where the case is.
  const glm::dquat rotation = rotationFromVector(gaussianVector(rng, radFromDegrees(care.screen_turn_sd_deg)));
  actual.X_WI = {rotation * believed.X_WI.rotation,
                 rotation * believed.X_WI.translation_mm + gaussianVector(rng, care.screen_shift_sd_mm)};
  return actual;
}

SeenError seenError(const SyntheticRig& rig, const MeasuredArm& calibrated, const glm::dvec3& half_mm,
                    const ViewingCare& care, int positions, std::mt19937& rng) {
  const Viewing believed = believedViewing(rig.nominal);
  const Viewing actual = actualViewing(believed, care, rng);
  SeenError error{.positions = positions};
  for (const Touch& touch : heldOutTouches(rig, positions, half_mm, rng)) {
    const Point<World> seen_W = seenPlace(believed, actual, calibrated.tip_W(touch.joints_rad));
    const double off_mm = glm::length((seen_W - touch.target_W).xyz);
    error.mean_mm += off_mm / positions;
    error.rms_mm += off_mm * off_mm / positions;
    error.max_mm = std::max(error.max_mm, off_mm);
  }
  error.rms_mm = std::sqrt(error.rms_mm);
  return error;
}

}  // namespace calibration
