#include "calibration/fit/touch_checks.h"

#include <algorithm>
#include <cmath>

#include <libqhull_r/qhull_ra.h>
#include <Eigen/Dense>
#include <glm/gtc/type_ptr.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/pose.h"
#include "calibration/geometry/units.h"

namespace calibration {
namespace {

constexpr std::size_t kMinTouches = 4;
constexpr double kSameAngle_rad = 1e-7;
constexpr double kNarrow_mm = 3.0;  ///< RMS extent across a line of targets
constexpr double kFlatHull_mm = 0.02;
constexpr std::size_t kDirections = 400;

[[noreturn]] void refuseTouches(const std::string& what) { throw CalibrationError("touches: " + what); }

bool sameAngles(const RawJoints& a, const RawJoints& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > kSameAngle_rad) return false;
  return true;
}

void checkTwice(const std::vector<const Touch*>& touches) {
  std::vector<const Touch*> sorted = touches;
  std::ranges::stable_sort(sorted, {}, [](const Touch* touch) { return touch->joints_rad; });
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sameAngles(sorted[i - 1]->joints_rad, sorted[i]->joints_rad))
      refuseTouches("touch " + std::to_string(sorted[i]->id) + " is touch " + std::to_string(sorted[i - 1]->id) +
                    " again, with the same joint angles, remove one or touch anew");
}

}  // namespace

bool isFinite(const Touch& touch) {
  const auto finite = [](double angle_rad) { return std::isfinite(angle_rad); };
  return isFinite(touch.target_W.mm) && std::ranges::all_of(touch.joints_rad, finite);
}

void checkTouches(const TouchSet& set) {
  if (!findPhantomModel(set.device_model))
    refuseTouches("device model '" + set.device_model + "' is not known, correct it");
  std::vector<const Touch*> used;
  std::vector<glm::dvec3> positions;
  for (const Touch& touch : set.touches) {
    if (!isFinite(touch))
      refuseTouches("touch " + std::to_string(touch.id) + " holds a value that is not finite, touch it again");
    if (!touch.used) continue;
    used.push_back(&touch);
    positions.push_back(touch.target_W.mm);
  }
  if (!(set.precision.in_plane_mm >= 0.0) || !(set.precision.along_sight_mm >= 0.0) ||
      !std::isfinite(set.precision.in_plane_mm + set.precision.along_sight_mm))
    refuseTouches("their precision is not valid, give one sigma in mm");
  if (used.size() < kMinTouches)
    refuseTouches(std::to_string(used.size()) +
                  " are used, at least 4 are needed, touch more (16 for a good calibration)");
  checkTwice(used);
  const Extent extent = extentOf(positions);
  if (extent.spread_mm[0] < kNarrow_mm)
    refuseTouches("all targets are at one position, touch targets that are spread out");
  if (extent.spread_mm[1] < kNarrow_mm) refuseTouches("all targets lie on a line, touch some to the sides of it");
}

void checkUnseen(const TouchSet& fitted, const TouchSet& verification) {
  const auto must_agree = [](const std::string& what, const std::string& a, const std::string& b) {
    if (!a.empty() && !b.empty() && a != b)
      refuseTouches("they were made with " + what + " '" + a + "', the verification touches with '" + b +
                    "', give touches of one device");
  };
  must_agree("device model", fitted.device_model, verification.device_model);
  must_agree("serial", fitted.serial, verification.serial);
  must_agree("mount", fitted.mount, verification.mount);
  for (const Touch& one : verification.touches)
    for (const Touch& seen : fitted.touches)
      if (one.used && seen.used && sameAngles(one.joints_rad, seen.joints_rad))
        refuseTouches("touch " + std::to_string(one.id) + " of the verification is touch " + std::to_string(seen.id) +
                      " of the fit, touch other positions");
}

void checkUnseen(const std::vector<Residual>& fitted, const std::vector<Residual>& verification,
                 const std::string& file) {
  constexpr double kSame_mm = 1e-6;
  for (const Residual& one : verification)
    for (const Residual& seen : fitted)
      if (one.used && seen.used && glm::distance(one.target_W.mm, seen.target_W.mm) < kSame_mm &&
          glm::distance(one.error_mm.xyz, seen.error_mm.xyz) < kSame_mm)
        throw CalibrationError(file + ": touch " + std::to_string(one.id) +
                               " is one that the rig was fitted to, which verifies nothing, touch other positions");
}

double pairSpread_deg(const std::vector<glm::dvec3>& directions) {
  std::vector<double> angles;
  for (std::size_t a = 0; a < directions.size(); ++a)
    for (std::size_t b = a + 1; b < directions.size(); ++b)
      angles.push_back(std::acos(std::clamp(glm::dot(directions[a], directions[b]), -1.0, 1.0)));
  if (angles.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(angles.size() - 1));
  std::nth_element(angles.begin(), angles.begin() + at, angles.end());
  return degreesFromRad(angles[static_cast<std::size_t>(at)]);
}

double tiltSpread_deg(const PhantomGeometry& geometry, const std::vector<Touch>& touches,
                      std::span<const std::size_t> which) {
  std::vector<glm::dvec3> in_room, against_forearm;
  const std::size_t stride = which.size() / kDirections + 1;
  for (std::size_t i = 0; i < which.size(); i += stride) {
    const RawJoints& raw = touches[which[i]].joints_rad;
    in_room.push_back(handlePose(geometry, ArmCorrection{}, raw).rotation * glm::dvec3(0.0, 0.0, 1.0));
    const RawJoints gimbal_alone{0.0, 0.0, 0.0, raw[3], raw[4], raw[5]};
    against_forearm.push_back(handlePose(geometry, ArmCorrection{}, gimbal_alone).rotation * glm::dvec3(0.0, 0.0, 1.0));
  }
  return std::min(pairSpread_deg(in_room), pairSpread_deg(against_forearm));
}

double hullVolume_mm3(const std::vector<glm::dvec3>& positions_mm) {
  if (positions_mm.size() < kMinTouches) return 0.0;
  if (extentOf(positions_mm).spread_mm[2] < kFlatHull_mm) return 0.0;
  std::vector<glm::dvec3> positions = positions_mm;
  char options[] = "qhull";
  qhT hull;
  qh_zero(&hull, nullptr);
  if (qh_new_qhull(&hull, 3, static_cast<int>(positions.size()), glm::value_ptr(positions.front()), False, options,
                   nullptr, nullptr) == qh_ERRnone)
    qh_getarea(&hull, hull.facet_list);
  const double volume_mm3 = hull.totvol;
  qh_freeqhull(&hull, qh_ALL);
  return volume_mm3;
}

Extent extentOf(const std::vector<glm::dvec3>& positions_mm) {
  Extent extent;
  if (positions_mm.empty()) return extent;
  const double share = 1.0 / static_cast<double>(positions_mm.size());
  for (const glm::dvec3& p : positions_mm) extent.middle_mm += share * p;
  glm::dmat3 about_middle(0.0);
  for (const glm::dvec3& p : positions_mm)
    about_middle += share * glm::outerProduct(p - extent.middle_mm, p - extent.middle_mm);
  // Eigen sorts ascending.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> main(Eigen::Matrix3d::Map(glm::value_ptr(about_middle)));
  for (int k = 0; k < 3; ++k) {
    extent.spread_mm[k] = std::sqrt(std::max(0.0, main.eigenvalues()[2 - k]));
    extent.axes[k] = glm::make_vec3(main.eigenvectors().col(2 - k).data());
  }
  return extent;
}

}  // namespace calibration
